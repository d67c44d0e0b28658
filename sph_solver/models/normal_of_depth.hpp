#pragma once

#include "models/gradient_correction.hpp"
#include "models/surface_geometry.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Normal of the interface between two phases, by how depth falls off over its band: the gradient g of depth by least
/// squares with the weights δ_j W_ij,
///
///   n̂_i = −g/|g|,   [Σ_j δ_j W_ij Δx ⊗ Δx] g = Σ_j δ_j W_ij (s_j − s_i) Δx,   Δx = x_j − x_i      [1]
///
/// exact where depth is linear, however particles lie and whatever part of the band a wall takes away. The gradient of
/// colour, which is 0 or 1, follows single particles; depth has been through a kernel. Along straight lines drawn at 60
/// to 120 degrees through the particles of a drop at rest, each side a colour, the mean of normals that a wall particle
/// sees strays by 2 degrees, and by 4 with smoothed gradients of colour; in the wedge of a line at 30 degrees it is too
/// steep by 0.2 to 0.6 degrees, and by 1.5 to 1.7 (4.5 before smoothing).
/// Where two interfaces are so close that depth says little of either (|g| below 0.3, of 1 at a single one; chosen),
/// the normal stays that of the colour gradient.
/// Source: own; the gradient is the first-order moving least squares of Dilts 1999 with the band's weights.
struct NormalOfDepth
{
    static constexpr double smallest_gradient = 0.3;

    Mobility mobility;
    int dimensions;
    SurfaceFields surface;

    struct Near
    {
        Lanes depth;
    };
    struct Far
    {
        Real weight, depth; ///< δ_j, 0 where there is no surface; s_j
    };
    struct Sum
    {
        Symmetric3<Lanes> moment{};
        VectorLanes change{};
    };

    unsigned in_band(const Cluster& cluster) const
    {
        return set_lanes(lanes(surface.delta, cluster.first) > 0.0) & mobility.moving_in(cluster);
    }
    bool idle(const Cluster& cluster) const { return in_band(cluster) == 0; }
    Near near(Index first) const { return {lanes(surface.depth, first)}; }
    Far far(Index j) const { return {real(std::max(0.0, surface.delta[j])), real(surface.depth[j])}; }
    bool ignores(const Far& j) const { return j.weight == 0; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const VectorLanes weighted = (j.weight * pair.kernel) * pair.offset;
        sum.moment.xx += weighted.x * pair.offset.x;
        sum.moment.xy += weighted.x * pair.offset.y;
        sum.moment.xz += weighted.x * pair.offset.z;
        sum.moment.yy += weighted.y * pair.offset.y;
        sum.moment.yz += weighted.y * pair.offset.z;
        sum.moment.zz += weighted.z * pair.offset.z;
        sum.change += (j.depth - i.depth) * weighted;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        // Moments relative to their mean, so that whether they have an inverse does not depend on units.
        const auto& m = sum.moment;
        const Lanes trace = m.xx + m.yy + m.zz;
        const Lanes scale = select(trace > Lanes(0.0), Lanes(real(dimensions)) / trace, Lanes(0.0));
        const Symmetric3<Lanes> moment{scale * m.xx, scale * m.xy, scale * m.xz,
                                       scale * m.yy, scale * m.yz, scale * m.zz};
        // Offsets point from j to i, and the normal out of the liquid: two signs that cancel.
        const VectorLanes outward = safe_inverse(moment, dimensions) * (scale * sum.change);
        const Lanes length = square_root(dot(outward, outward));
        const VectorLanes colour_normal = lanes(surface.normal, cluster.first);
        const LaneMask says_where = length > Lanes(real(smallest_gradient));
        const Lanes per_length = Lanes(1.0) / select(says_where, length, 1.0);
        const VectorLanes normal{select(says_where, per_length * outward.x, colour_normal.x),
                                 select(says_where, per_length * outward.y, colour_normal.y),
                                 select(says_where, per_length * outward.z, colour_normal.z)};
        store_lanes(surface.smoothed_normal, cluster.first, in_band(cluster), normal);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
