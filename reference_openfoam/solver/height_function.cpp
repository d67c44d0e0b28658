#include <algorithm>
#include <cmath>

#include "fixedGradientFvPatchFields.H"
#include "height_function.hpp"
#include "paraboloid_fit.hpp"
#include "processorFvPatch.H"

namespace cupel
{
namespace
{
const scalar full = 0.99, empty_share = 0.01; // where a column counts as inside or outside
const scalar turn = 0.02;                     // how far α may go back on the way: noise
const int fit_reach = 2;                      // columns on each side whose heights a paraboloid is fitted to,
// with Gaussian weights of this width in cells. A wider fit of second order answers a zigzag of the surface with the
// wrong sign and lets it grow: in a row of points −2 … 2 with weights exp(−d²/w²) from w = 1.5 on
const scalar fit_width = 0.8;
const scalar small_slope = 1e-3; // at a side: below it the arc has no more to say than a straight line
const int reach = 9; // cells on each side: MULES spreads the interface over three or four, seen along a diagonal over
                     // six, and the columns beside it stand two cells higher or lower

/// First and second derivative at the middle of three points at −a, 0, b.
void derivatives(scalar below, scalar here, scalar above, scalar a, scalar b, scalar& first, scalar& second)
{
    const scalar slope_below = (here - below) / a, slope_above = (above - here) / b;
    first = (slope_below * b + slope_above * a) / (a + b);
    second = 2 * (slope_above - slope_below) / (a + b);
}

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

bool HeightFunction::curvature_along(const std::vector<scalar>& fraction, const Index& cell, int axis, int outward,
                                     scalar& curvature) const
{
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    scalar heights[3][3] = {};
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
    const auto distance = [this](int along, int index) { return spacing_between(along, index); };
    scalar first_x = 0, second_x = 0, first_y = 0, second_y = 0, mixed = 0;
    if (!flat_x)
        derivatives(heights[0][1], heights[1][1], heights[2][1], distance(x, cell[x] - 1), distance(x, cell[x]),
                    first_x, second_x);
    if (!flat_y)
        derivatives(heights[1][0], heights[1][1], heights[1][2], distance(y, cell[y] - 1), distance(y, cell[y]),
                    first_y, second_y);
    if (!flat_x && !flat_y) {
        mixed = (heights[2][2] - heights[2][0] - heights[0][2] + heights[0][0]) /
                ((distance(x, cell[x] - 1) + distance(x, cell[x])) * (distance(y, cell[y] - 1) + distance(y, cell[y])));
    }
    const scalar numerator =
        second_x * (1 + sqr(first_y)) + second_y * (1 + sqr(first_x)) - 2 * mixed * first_x * first_y;
    curvature = -numerator / std::pow(1 + sqr(first_x) + sqr(first_y), 1.5);
    return mag(curvature) * spacing_ < 2; // a sphere smaller than a cell is noise
}

bool HeightFunction::curvature_of_fit(const std::vector<scalar>& fraction, const Index& cell, const vector& outward,
                                      scalar& curvature) const
{
    const auto centre = [this](const Index& place) {
        return vector(grid_.line(0).centres[place[0]], grid_.line(1).centres[place[1]],
                      grid_.line(2).centres[place[2]]);
    };
    const vector here = centre(cell);
    std::vector<vector> points, footprints;
    std::vector<scalar> weights;
    std::vector<int> axes;
    int flat_axis = -1;
    for (int axis = 0; axis < 3; ++axis) {
        const int last = grid_.line(axis).count() - 1;
        if (last == 0)
            flat_axis = axis;
        else if (cell[axis] < fit_reach || cell[axis] > last - fit_reach)
            return false; // the points that the side cuts off would be missed, and its contact angle
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == flat_axis || mag(outward[axis]) < 0.3) continue;
        const int x = (axis + 1) % 3, y = (axis + 2) % 3, side = outward[axis] > 0 ? 1 : -1;
        for (int i = -fit_reach; i <= fit_reach; ++i)
            for (int j = -fit_reach; j <= fit_reach; ++j) {
                if ((x == flat_axis && i != 0) || (y == flat_axis && j != 0)) continue;
                Index column = cell;
                column[x] += i;
                column[y] += j;
                scalar position = 0;
                if (column[x] < 0 || column[y] < 0 || column[x] >= grid_.line(x).count() ||
                    column[y] >= grid_.line(y).count() || !height(fraction, column, axis, side, position))
                    continue;
                vector point = centre(column);
                point[axis] = side * position;
                const vector way = (point - here) / spacing_;
                if (mag(way) > fit_reach + 1) continue;
                points.push_back(point / spacing_);
                weights.push_back(std::exp(-(magSqr(way) - sqr(way & outward)) / sqr(fit_width)));
                axes.push_back(axis);
            }
    }
    ParaboloidFit surface(here / spacing_, outward, flat_axis);
    if (!surface.fit(points, weights)) return false;
    // a height is the mean over its column; its middle lies (H_xx + H_yy)/24 of a cell's area farther out
    const scalar radius_term = surface.curvature() / (flat_axis < 0 ? 2 : 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const scalar along = max(mag(surface.normal(points[i])[axes[i]]), scalar(0.3));
        const scalar hessian = radius_term * ((flat_axis < 0 ? 1 : 0) + 1 / sqr(along)) / along;
        points[i][axes[i]] += (outward[axes[i]] > 0 ? 1 : -1) * hessian / 24;
    }
    if (!surface.fit(points, weights)) return false;
    curvature = surface.curvature() / spacing_;
    return mag(curvature) * spacing_ < 2;
}

void HeightFunction::apply(volScalarField& curvature, const volScalarField& fraction,
                           const volVectorField& gradient) const
{
    const std::vector<scalar> shares = grid_.gathered(fraction.primitiveField());
    const scalar near_interface = 1e-3 / spacing_;
    forAll (curvature, cell) {
        const vector& slope = gradient[cell];
        if (mag(slope) < near_interface) continue;
        std::array<int, 3> axes = {{0, 1, 2}};
        std::sort(axes.begin(), axes.end(), [&slope](int one, int two) { return mag(slope[one]) > mag(slope[two]); });
        scalar value = 0;
        bool found = false;
        for (int choice = 0; choice < 2 && !found; ++choice) {
            const int axis = axes[choice];
            if (mag(slope[axis]) < 0.3 * mag(slope)) break;
            found = curvature_along(shares, grid_.index(cell), axis, slope[axis] > 0 ? -1 : 1, value);
        }
        if (found || curvature_of_fit(shares, grid_.index(cell), -slope / mag(slope), value)) curvature[cell] = value;
    }
    curvature.correctBoundaryConditions();
}
} // namespace cupel
