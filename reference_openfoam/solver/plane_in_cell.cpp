#include "plane_in_cell.hpp"

#include <algorithm>
#include <cmath>

namespace cupel
{
namespace
{
const scalar negligible_slope = 1e-8;

/// |m| in rising order with sum one, and the volumes at which the pieces of V meet.
struct Pieces
{
    explicit Pieces(vector slopes)
    {
        std::sort(&slopes[0], &slopes[0] + 3);
        slopes /= slopes[0] + slopes[1] + slopes[2];
        if (slopes[0] < negligible_slope) slopes[0] = 0; // its cubic piece would be round-off over round-off
        a = slopes[0];
        b = slopes[1];
        c = slopes[2];
        six_products = max(6 * a * b * c, scalar(1e-50));
        corner = a * a * a / six_products;
        edge = corner + (b - a) / (2 * c);
        at_side = c < a + b ? (c * c * (3 * (a + b) - c) + a * a * (a - 3 * c) + b * b * (b - 3 * c)) / six_products
                            : (a + b) / (2 * c);
    }

    scalar a, b, c, six_products;
    scalar corner, edge, at_side; // V(a), V(b), V(min(c, a + b))
};

/// The root of the cubic piece between `middle` − √p and `middle`, by Viète's formula.
scalar middle_root(scalar p, scalar q, scalar middle)
{
    const scalar root = std::sqrt(p), cosine = max(min(q / (p * root), scalar(1)), scalar(-1));
    const scalar angle = std::acos(cosine) / 3;
    return middle + root * (std::sqrt(scalar(3)) * std::sin(angle) - std::cos(angle));
}
} // namespace

scalar volume_below(const vector& slopes, scalar distance)
{
    if (distance <= 0) return 0;
    if (distance >= 1) return 1;
    const Pieces p(slopes);
    const scalar a = p.a, b = p.b, c = p.c, d = min(distance, 1 - distance);
    scalar volume = 0;
    if (d < a)
        volume = d * d * d / p.six_products;
    else if (d < b)
        volume = d * (d - a) / (2 * b * c) + p.corner;
    else if (d < min(c, a + b))
        volume = (d * d * (3 * (a + b) - d) + a * a * (a - 3 * d) + b * b * (b - 3 * d)) / p.six_products;
    else if (a + b < c)
        volume = (2 * d - a - b) / (2 * c);
    else
        volume =
            (d * d * (3 - 2 * d) + a * a * (a - 3 * d) + b * b * (b - 3 * d) + c * c * (c - 3 * d)) / p.six_products;
    return distance <= 0.5 ? volume : 1 - volume;
}

scalar distance_of(const vector& slopes, scalar volume)
{
    const Pieces p(slopes);
    const scalar a = p.a, b = p.b, c = p.c, v = max(min(volume, 1 - volume), scalar(0));
    scalar d = 0;
    if (v < p.corner)
        d = std::cbrt(p.six_products * v);
    else if (v < p.edge)
        d = 0.5 * (a + std::sqrt(a * a + 8 * b * c * (v - p.corner)));
    else if (v < p.at_side)
        d = middle_root(2 * a * b, 1.5 * a * b * (a + b - 2 * c * v), a + b);
    else if (a + b < c)
        d = c * v + 0.5 * (a + b);
    else
        d = middle_root(a * (b + c) + b * c - 0.25, 1.5 * a * b * c * (0.5 - v), 0.5);
    return volume <= 0.5 ? d : 1 - d;
}

scalar volume_in_slab(const vector& outward, scalar share, int axis, bool upper, scalar thickness)
{
    vector slopes(mag(outward[0]), mag(outward[1]), mag(outward[2]));
    slopes /= slopes[0] + slopes[1] + slopes[2];
    scalar distance = distance_of(slopes, share);
    // turned so that the region lies toward the origin: the slab is at the lower side if its own side is the region's
    const bool far = upper == (outward[axis] >= 0);
    if (far) distance -= slopes[axis] * (1 - thickness);
    vector within(slopes);
    within[axis] *= thickness;
    const scalar sum = within[0] + within[1] + within[2];
    if (sum < 1e-12) return distance > 0 ? thickness : 0;
    return thickness * volume_below(within / sum, distance / sum);
}
} // namespace cupel
