#include <algorithm>
#include <cmath>

#include "height_function.hpp"
#include "paraboloid_fit.hpp"

namespace cupel
{
namespace
{
const scalar steepest = 1; // slope on an edge: beyond it five columns are less exact than a paraboloid
// The same of the slope along the edge, which is of second order only there: a sphere of ten cells a radius is −2.1 %
// off in the worst place without this, −0.1 % with it
const scalar steepest_across = 0.5;
const int fit_reach = 2; // columns on each side whose heights a paraboloid is fitted to,
// with Gaussian weights of this width in cells. A wider fit of second order answers a zigzag of the surface with the
// wrong sign and lets it grow: in a row of points −2 … 2 with weights exp(−d²/w²) from w = 1.5 on
const scalar fit_width = 0.8;
// Component of the surface's normal along its column from which on a height counts at all, and fully. Columns at a
// body's limb, partly outside it, have a height or none as their fullest cell has 0.99 or less, and it is no mean
const scalar slanted = 0.5, upright = 0.7;

scalar ramp(scalar value, scalar from, scalar to)
{
    const scalar t = min(max((value - from) / (to - from), scalar(0)), scalar(1));
    return sqr(t) * (3 - 2 * t);
}

/// First and second derivative at the middle of three points at −a, 0, b.
void derivatives(scalar below, scalar here, scalar above, scalar a, scalar b, scalar& first, scalar& second)
{
    const scalar slope_below = (here - below) / a, slope_above = (above - here) / b;
    first = (slope_below * b + slope_above * a) / (a + b);
    second = 2 * (slope_above - slope_below) / (a + b);
}
} // namespace

bool HeightFunction::curvature_along(const std::vector<scalar>& fraction, const Index& cell, int axis, int outward,
                                     bool by_edges, scalar& curvature) const
{
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    const bool flat_x = grid_.line(x).count() == 1, flat_y = grid_.line(y).count() == 1;
    scalar heights[3][3] = {};
    if (!stencil(fraction, cell, axis, outward, heights)) return false;
    if (by_edges) return curvature_of_edges(fraction, cell, axis, outward, heights, curvature);
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

bool HeightFunction::curvature_of_edges(const std::vector<scalar>& fraction, const Index& cell, int axis, int outward,
                                        const scalar (&heights)[3][3], scalar& curvature) const
{
    const int axes[2] = {(axis + 1) % 3, (axis + 2) % 3};
    const bool flat[2] = {grid_.line(axes[0]).count() == 1, grid_.line(axes[1]).count() == 1};
    scalar width[2] = {1, 1}, farther[2][2] = {}, missing[2] = {};
    const auto at = [&](int along, int i, int j) { return along == 0 ? heights[1 + i][1 + j] : heights[1 + j][1 + i]; };
    for (int along = 0; along < 2; ++along) {
        if (flat[along]) continue;
        const int line = axes[along];
        width[along] = grid_.line(line).widths[cell[line]];
        if (mag(spacing_between(line, cell[line] - 1) - width[along]) > 1e-3 * width[along] ||
            mag(spacing_between(line, cell[line]) - width[along]) > 1e-3 * width[along])
            return false;
        for (int end = 0; end < 2; ++end)
            if (!height_farther(fraction, cell, line, end == 0 ? -1 : 1, axis, outward, farther[along][end]))
                return false;
        // what the slope in the middle by means over five columns has beyond that by two
        missing[along] = (10 * (at(along, 1, 0) - at(along, -1, 0)) - 5 * (farther[along][1] - farther[along][0])) /
                         (48 * width[along]);
    }
    curvature = 0;
    for (int along = 0; along < 2; ++along)
        for (int way = -1; way <= 1 && !flat[along]; way += 2) {
            const int cross = 1 - along;
            // from means over columns, of fourth order on the edge between two of them
            const scalar slope =
                (15 * (at(along, way, 0) - at(along, 0, 0)) - (farther[along][way > 0] - at(along, -way, 0))) /
                (12 * width[along]);
            const scalar beside =
                (at(along, 0, 1) - at(along, 0, -1) + at(along, way, 1) - at(along, way, -1)) / (4 * width[cross]) +
                missing[cross];
            if (mag(slope) > steepest || mag(beside) > steepest_across) return false;
            curvature -= slope / std::sqrt(1 + sqr(slope) + sqr(beside)) / width[along];
        }
    return true;
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
        if (axis == flat_axis || mag(outward[axis]) < 0.1) continue;
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
        const scalar component = mag(surface.normal(points[i])[axes[i]]), along = max(component, scalar(0.3));
        const scalar hessian = radius_term * ((flat_axis < 0 ? 1 : 0) + 1 / sqr(along)) / along;
        points[i][axes[i]] += (outward[axes[i]] > 0 ? 1 : -1) * hessian / 24;
        weights[i] *= ramp(component, slanted, upright);
    }
    if (!surface.fit(points, weights)) return false;
    const std::vector<vector> middles(points);
    for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t i = 0; i < points.size(); ++i)
            points[i] = middles[i] - surface.bend_beyond(middles[i]) * outward;
        if (!surface.fit(points, weights)) return false;
    }
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
        const auto along = [&](int axis, bool by_edges, scalar& value) {
            return mag(slope[axis]) > 0.3 * mag(slope) &&
                   curvature_along(shares, grid_.index(cell), axis, slope[axis] > 0 ? -1 : 1, by_edges, value);
        };
        scalar value = 0;
        if (along(axes[0], true, value) || curvature_of_fit(shares, grid_.index(cell), -slope / mag(slope), value) ||
            along(axes[0], false, value) || along(axes[1], false, value))
            curvature[cell] = value;
    }
    curvature.correctBoundaryConditions();
}
} // namespace cupel
