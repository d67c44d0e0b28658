#include <algorithm>
#include <cmath>

#include "fixedGradientFvPatchFields.H"
#include "height_function.hpp"
#include "processorFvPatch.H"

namespace cupel
{
namespace
{
const scalar full = 0.99, empty_share = 0.01; // where a column counts as inside or outside
const scalar turn = 0.02;                     // how far α may go back on the way: noise
const scalar small_slope = 1e-3;              // at a side: below it the arc has no more to say than a straight line
const int reach = 9; // cells on each side: a column along a steep interface crosses many of them

/// Mean over [from, to] of the height of an arc that has height 0 at z = 0 and sine of slope q(z) = start − κ z.
scalar mean_of_arc(scalar start, scalar curvature, scalar from, scalar to)
{
    const auto primitive = [](scalar q) { return 0.5 * (q * std::sqrt(max(1 - q * q, scalar(0))) + std::asin(q)); };
    const auto sine = [=](scalar z) { return max(min(start - curvature * z, scalar(1)), scalar(-1)); };
    const scalar mean = (primitive(sine(from)) - primitive(sine(to))) / (curvature * (to - from));
    return (mean - std::sqrt(1 - sqr(start))) / curvature;
}

/// Height behind a side at which the surface has `slope`, away from it. With differences of second order alone a
/// surface that bends as much over a cell as its slope is has the wrong curvature in the row at the side (−9.5 % for a
/// cap of 150° on seven cells a radius). So: the arc with that slope whose means over the first two rows differ as
/// theirs do; then the height that gives its curvature by differences of second order.
scalar height_behind(scalar first, scalar second, scalar slope, scalar width)
{
    const scalar linear = first - slope * width, rise = (second - first) / width,
                 start = slope / std::sqrt(1 + sqr(slope));
    if (mag(slope) < small_slope) return linear;
    scalar low = 0.5 * (start - 1), high = 0.5 * (start + 1); // the slope is finite up to the end of the second row
    const auto excess = [=](scalar curvature) {
        const scalar bent = mag(curvature) < 1e-5 ? std::copysign(1e-5, curvature) : curvature;
        return mean_of_arc(start, bent, 1, 2) - mean_of_arc(start, bent, 0, 1) - rise;
    };
    if (excess(low) < 0 || excess(high) > 0) return linear;
    for (int halving = 0; halving < 40; ++halving) {
        const scalar middle = 0.5 * (low + high);
        (excess(middle) > 0 ? low : high) = middle;
    }
    scalar behind = first / width - slope; // in cells
    for (int iteration = 0; iteration < 20; ++iteration) {
        const scalar across = 0.5 * (second / width - behind), stretch = std::sqrt(1 + sqr(across));
        const scalar bend = second / width - 2 * first / width + behind + low * pow3(stretch);
        behind -= bend / max(1 - 1.5 * low * stretch * across, scalar(0.2));
    }
    return mag(behind * width - linear) < width ? behind * width : linear;
}
} // namespace

HeightFunction::HeightFunction(const volScalarField& fraction, scalar spacing, scalar contact_angle)
    : grid_(fraction.mesh(), spacing), spacing_(spacing)
{
    const fvMesh& mesh = fraction.mesh();
    forAll (mesh.boundary(), patch) {
        const fvPatch& boundary = mesh.boundary()[patch];
        if (isA<processorFvPatch>(boundary)) continue; // other ranks have others, and the sum below is over all ranks
        const fvPatchScalarField& values = fraction.boundaryField()[patch];
        const bool wets = isA<fixedGradientFvPatchScalarField>(values);
        const bool continues =
            wets || isA<zeroGradientFvPatchScalarField>(values) || boundary.type() == "symmetryPlane";
        const vector outward = gSum(boundary.Sf());
        for (int axis = 0; axis < 3; ++axis) {
            if (boundary.type() == "cyclic" && mag(outward[axis]) > 0.9 * mag(outward)) periodic_[axis] = true;
            if (!continues || mag(outward[axis]) < 0.9 * mag(outward)) continue;
            Side& side = sides_[axis][outward[axis] > 0 ? 1 : 0];
            side.continues = true;
            side.wets = wets;
            side.cotangent = wets ? Foam::cos(contact_angle) / Foam::sin(contact_angle) : 0;
        }
    }
}

bool HeightFunction::height(const std::vector<scalar>& fraction, Index start, int axis, int outward,
                            scalar& position) const
{
    const BlockGrid::Line& line = grid_.line(axis);
    const int count = line.count(), from = start[axis];
    const auto is_beyond = [&](int k) { return !periodic_[axis] && (k < 0 || k >= count); };
    const auto share = [&](int k) {
        start[axis] = inside_period(axis, k);
        return fraction[grid_.flat(start)];
    };
    // from the cell to where it is full, and to where it is empty; a turn on the way is another surface
    int inside = from, outside = from;
    for (int step = 0; share(inside) < full; ++step) {
        inside -= outward;
        if (step == reach || is_beyond(inside) || share(inside) < share(inside + outward) - turn) return false;
    }
    for (int step = 0; share(outside) > empty_share; ++step) {
        outside += outward;
        if (step == reach || is_beyond(outside) || share(outside) > share(outside - outward) + turn) return false;
    }
    const int inside_here = inside_period(axis, inside);
    const scalar whole_periods = (inside - inside_here) / count * (line.faces.back() - line.faces.front());
    position = outward * (line.centres[inside_here] + whole_periods) - 0.5 * line.widths[inside_here];
    for (int k = inside; k != outside + outward; k += outward)
        position += min(max(share(k), scalar(0)), scalar(1)) * line.widths[inside_period(axis, k)];
    return true;
}

int HeightFunction::inside_period(int axis, int index) const
{
    const int count = grid_.line(axis).count();
    return periodic_[axis] ? ((index % count) + count) % count : index;
}

scalar HeightFunction::spacing_between(int axis, int index) const
{
    const BlockGrid::Line& line = grid_.line(axis);
    const bool at_end = index < 0 || index + 1 >= line.count();
    if (at_end && periodic_[axis]) return 0.5 * (line.widths.front() + line.widths.back());
    if (at_end) return index < 0 ? line.widths.front() : line.widths.back();
    return line.centres[index + 1] - line.centres[index];
}

scalar HeightFunction::slope(const scalar (&row)[3], int axis, int index) const
{
    const int last = grid_.line(axis).count() - 1;
    if (last == 0) return 0;
    const bool has_below = index > 0 || periodic_[axis], has_above = index < last || periodic_[axis];
    const int from = has_below ? 0 : 1, to = has_above ? 2 : 1; // one-sided beside a side
    const scalar below = has_below ? spacing_between(axis, index - 1) : 0,
                 above = has_above ? spacing_between(axis, index) : 0;
    return (row[to] - row[from]) / (below + above);
}

bool HeightFunction::stencil(const std::vector<scalar>& fraction, const Index& cell, int axis, int outward,
                             scalar (&heights)[3][3]) const
{
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    const bool flat_x = grid_.line(x).count() == 1, flat_y = grid_.line(y).count() == 1; // a scene in a plane
    const auto is_behind = [this](int along, int index) {
        return !periodic_[along] && (index < 0 || index >= grid_.line(along).count());
    };
    for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j) {
            Index column = cell;
            column[x] += flat_x ? 0 : i;
            column[y] += flat_y ? 0 : j;
            if (is_behind(x, column[x]) || is_behind(y, column[y])) continue;
            column[x] = inside_period(x, column[x]);
            column[y] = inside_period(y, column[y]);
            if (!height(fraction, column, axis, outward, heights[i + 1][j + 1])) return false;
        }
    // rows behind a side: first those along x, then those along y with the corners that the first have filled
    for (int i = -1; i <= 1 && !flat_x; i += 2) {
        if (!is_behind(x, cell[x] + i)) continue;
        const Side& side = sides_[x][i > 0];
        if (!side.continues) return false;
        for (int j = 0; j < 3; ++j) {
            if (!flat_y && is_behind(y, cell[y] + j - 1)) continue;
            const scalar along = slope(heights[1], y, cell[y]);
            heights[i + 1][j] =
                height_behind(heights[1][j], heights[1 - i][j], -side.cotangent * std::sqrt(1 + sqr(along)),
                              grid_.line(x).widths[cell[x]]);
        }
    }
    for (int j = -1; j <= 1 && !flat_y; j += 2) {
        if (!is_behind(y, cell[y] + j)) continue;
        const Side& side = sides_[y][j > 0];
        if (!side.continues) return false;
        const scalar middle[3] = {heights[0][1], heights[1][1], heights[2][1]};
        for (int i = 0; i < 3; ++i) {
            heights[i][j + 1] = height_behind(heights[i][1], heights[i][1 - j],
                                              -side.cotangent * std::sqrt(1 + sqr(slope(middle, x, cell[x]))),
                                              grid_.line(y).widths[cell[y]]);
        }
    }
    return true;
}

bool HeightFunction::height_farther(const std::vector<scalar>& fraction, Index column, int along, int way, int axis,
                                    int outward, scalar& position) const
{
    const BlockGrid::Line& line = grid_.line(along);
    const int here = column[along], count = line.count();
    int target = here + 2 * way;
    if (periodic_[along])
        target = inside_period(along, target);
    else if (target < 0 || target >= count) {
        const Side& side = sides_[along][way > 0];
        if (!side.continues || side.cotangent != 0) return false;
        target = way > 0 ? 2 * count - 1 - target : -1 - target; // its mirror image
    }
    if (target < 0 || target >= count || mag(line.widths[target] - line.widths[here]) > 1e-3 * line.widths[here])
        return false;
    column[along] = target;
    return height(fraction, column, axis, outward, position);
}

vector HeightFunction::slope_of_share(const std::vector<scalar>& fraction, const Index& cell) const
{
    vector slope(Zero);
    for (int axis = 0; axis < 3; ++axis) {
        if (grid_.line(axis).count() == 1) continue;
        for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j) {
                const scalar weight = (2 - mag(i)) * (2 - mag(j));
                slope[axis] +=
                    weight * (share_near(fraction, cell, axis, 1, i, j) - share_near(fraction, cell, axis, -1, i, j));
            }
        slope[axis] /= spacing_between(axis, cell[axis] - 1) + spacing_between(axis, cell[axis]);
    }
    return slope;
}

bool HeightFunction::best_stencil(const std::vector<scalar>& fraction, const Index& cell, const vector& slope,
                                  Stencil& best) const
{
    std::array<int, 3> axes = {{0, 1, 2}};
    std::sort(axes.begin(), axes.end(), [&slope](int one, int two) { return mag(slope[one]) > mag(slope[two]); });
    for (int choice = 0; choice < 2; ++choice) {
        best.axis = axes[choice];
        if (mag(slope[best.axis]) < 0.3 * mag(slope)) return false;
        best.outward = slope[best.axis] > 0 ? -1 : 1;
        if (stencil(fraction, cell, best.axis, best.outward, best.heights)) {
            const int x = (best.axis + 1) % 3, y = (best.axis + 2) % 3;
            best.slope_x = (best.heights[2][1] - best.heights[0][1]) /
                           (spacing_between(x, cell[x] - 1) + spacing_between(x, cell[x]));
            best.slope_y = (best.heights[1][2] - best.heights[1][0]) /
                           (spacing_between(y, cell[y] - 1) + spacing_between(y, cell[y]));
            return true;
        }
    }
    return false;
}

vector HeightFunction::outward_normal(const std::vector<scalar>& fraction, const Index& cell) const
{
    vector slope = slope_of_share(fraction, cell);
    Stencil columns;
    if (best_stencil(fraction, cell, slope, columns)) {
        vector normal(Zero);
        normal[columns.axis] = columns.outward;
        normal[(columns.axis + 1) % 3] = -columns.slope_x;
        normal[(columns.axis + 2) % 3] = -columns.slope_y;
        return normal;
    }
    for (int axis = 0; axis < 3; ++axis)
        for (int end = 0; end < 2; ++end) {
            const Side& side = sides_[axis][end];
            if (!side.wets || cell[axis] != (end == 0 ? 0 : grid_.line(axis).count() - 1)) continue;
            vector along(slope);
            along[axis] = 0;
            if (mag(along) < 1e-3 * mag(slope)) continue;
            slope = along / mag(along);
            slope[axis] = (end == 0 ? -1 : 1) * side.cotangent;
        }
    return mag(slope) > 0 ? vector(-slope) : vector(0, 0, 1);
}

bool HeightFunction::surface_value(const std::vector<scalar>& fraction, const std::vector<scalar>& values,
                                   scalar weight_inside, const Index& cell, scalar& value, vector& gradient) const
{
    Stencil columns;
    if (!best_stencil(fraction, cell, slope_of_share(fraction, cell), columns)) return false;
    const int axis = columns.axis, x = (axis + 1) % 3, y = (axis + 2) % 3;
    const BlockGrid::Line& line = grid_.line(axis);
    // from one side in a straight line through its last two cells, if both are that side's
    const auto continued = [&](Index column, int first, int step, bool inside, scalar height) {
        const auto in_scene = [&](int k) { return periodic_[axis] || (k >= 0 && k < line.count()); };
        const auto place = [&](int k) {
            column[axis] = inside_period(axis, k);
            return grid_.flat(column);
        };
        const scalar here = values[place(first)];
        if (!in_scene(first + step) || (fraction[place(first + step)] > 0.5) != inside) return here;
        const scalar rate = (here - values[place(first + step)]) / spacing_between(axis, step > 0 ? first : first - 1);
        return here + rate * mag(height - line.centres[inside_period(axis, first)]);
    };
    scalar at_surface[3][3] = {};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            Index column = cell;
            column[x] += grid_.line(x).count() == 1 ? 0 : i - 1;
            column[y] += grid_.line(y).count() == 1 ? 0 : j - 1;
            const auto is_behind = [&](int along) {
                return !periodic_[along] && (column[along] < 0 || column[along] >= grid_.line(along).count());
            };
            if (is_behind(x) || is_behind(y)) continue;
            column[x] = inside_period(x, column[x]);
            column[y] = inside_period(y, column[y]);
            const scalar height = columns.outward * columns.heights[i][j];
            const int above =
                int(std::upper_bound(line.centres.begin(), line.centres.end(), height) - line.centres.begin());
            const int in = columns.outward > 0 ? above - 1 : above, out = columns.outward > 0 ? above : above - 1;
            const bool has_in = in >= 0 && in < line.count(), has_out = out >= 0 && out < line.count();
            const scalar from_inside = has_in ? continued(column, in, -columns.outward, true, height) : 0;
            const scalar from_outside = has_out ? continued(column, out, columns.outward, false, height) : from_inside;
            at_surface[i][j] = has_in ? weight_inside * from_inside + (1 - weight_inside) * from_outside : from_outside;
        }
    value = at_surface[1][1];
    const scalar row_x[3] = {at_surface[0][1], at_surface[1][1], at_surface[2][1]};
    const scalar rate_x = slope(row_x, x, cell[x]), rate_y = slope(at_surface[1], y, cell[y]);
    // the surface's metric 1 + H_x², H_x H_y, 1 + H_y² turned round
    const scalar metric_x = 1 + sqr(columns.slope_x), metric_y = 1 + sqr(columns.slope_y),
                 mixed = columns.slope_x * columns.slope_y, determinant = metric_x * metric_y - sqr(mixed);
    gradient[x] = (metric_y * rate_x - mixed * rate_y) / determinant;
    gradient[y] = (metric_x * rate_y - mixed * rate_x) / determinant;
    gradient[axis] = columns.outward * (columns.slope_x * gradient[x] + columns.slope_y * gradient[y]);
    return true;
}

scalar HeightFunction::share_near(const std::vector<scalar>& fraction, Index cell, int axis, int ahead, int i,
                                  int j) const
{
    const std::array<int, 3> offsets = {{ahead, i, j}};
    for (int part = 0; part < 3; ++part) {
        const int along = (axis + part) % 3, last = grid_.line(along).count() - 1;
        cell[along] = inside_period(along, cell[along] + offsets[part]);
        cell[along] = min(max(cell[along], 0), last);
    }
    return fraction[grid_.flat(cell)];
}

} // namespace cupel
