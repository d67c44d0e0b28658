#pragma once

#include <algorithm>
#include <vector>

#include "models/surface_geometry.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Melt on its own solid: the surface is that of the metal, melt and solid together, as in a volume-of-fluid model.
///
/// Where melt ends on a dry solid their surfaces meet at an angle, and the metal's surface turns by it: a curvature
/// κ < 0, whose load σκ pulls the melt out over the solid,   ∫ σκ n̂ ds = σ (t̂_solid + t̂_melt)      [N/m],
/// which is nothing where the one surface goes on in the other, and Young's force for an angle of zero, σ (1 − cos θ)
/// along the solid, where it does not. Melt so spreads on what it froze from until its surface is smooth. Of that
/// curvature particles have what they see: a solid beside liquid therefore has a normal, a depth and a curvature, as
/// the liquid has, and the load that belongs to them (surface_pressure.hpp). Melt whose solid has no part in the
/// surface stops at some 70 degrees (validation_cases/melt_on_solid). Own derivation.
///
/// Who takes part:   m_i = 1 for a solid with liquid within 2.9 h, else 0. (A kernel reaches 3 h, where a lattice has
/// neighbours: round-off would decide.)
struct SolidBesideLiquid
{
    Mobility mobility;
    const std::vector<Kind>& kind;
    double smoothing_length; ///< h, m
    ScalarField& metal;      ///< m; 1 where liquid, 0 in walls

    struct Near
    {};
    struct Far
    {
        Real liquid;
    };
    struct Sum
    {
        Lanes liquid{};
    };

    bool is_solid(Index i) const
    {
        return mobility.weight[i] == 0.0 && kind[static_cast<std::size_t>(i)] != Kind::wall;
    }
    bool idle(const Cluster& cluster) const
    {
        return none_in(cluster, [&](Index i) { return is_solid(i); });
    }
    Near near(Index) const { return {}; }
    Far far(Index j) const { return {real(mobility.weight[j])}; }
    bool ignores(const Far& j) const { return j.liquid == 0; }
    void add(const Near&, const Far&, const Pair& pair, Sum& sum) const
    {
        const double reach = 2.9 * smoothing_length;
        sum.liquid += select(pair.square < reach * reach, 1.0, 0.0);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (is_solid(i)) metal[i] = sum.liquid[lane] > 0.0 ? 1.0 : 0.0;
        }
    }
};

/// The colour gradient of those solids. That of the liquid is found before densities change: in a cluster that holds
/// both it is left alone, or what it is would depend on how particles are sorted.
struct ColourGradientOfSolids : ColourGradient<false>
{
    Mobility liquid;

    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const unsigned solids = mobility.moving_in(cluster) & ~liquid.moving_in(cluster);
        store_lanes(surface.colour_gradient, cluster.first, solids, sum.gradient);
        store_lanes(surface.smoothed_colour, cluster.first, solids, sum.colour);
        store_lanes(surface.companions, cluster.first, solids, sum.companions);
    }
};

/// What of a particle's sky is free, by what lies within 40 degrees of its normal, counted in neighbours at one
/// spacing:
///
///   C_i = Σ_j V_j W_ij / (V₀ W(Δx)) over j of the band with n̂_i·(x_j − x_i) > 0.76 r,   e_i = clamp((3/4 − C_i)/(1/2))
///
/// It decides who is of the surface's first layer (share_of_surface). In a concave edge, where a front of melt meets
/// its solid or another, kernels are so full that what is at the surface looks two spacings deep; by depth its
/// curvature did not count, and melt came to rest with a front of 30 degrees. The normal is smoothed; the thresholds
/// are a half about a half, where a second layer has at least one. The angle is one at which a lattice has no
/// neighbours (35, 45 degrees): on it round-off would decide who counts.      [1]
struct Exposure
{
    Mobility mobility;
    double smallest_delta;    ///< below it a particle takes no part, 1/m
    double volume_at_spacing; ///< V₀ W(Δx)
    SurfaceFields surface;
    ScalarField& exposure; ///< e; 0 for what is not of the band

    struct Near
    {
        VectorLanes normal;
    };
    struct Far
    {
        Real covers; ///< 1 in the band
    };
    struct Sum
    {
        Lanes cover{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const { return {lanes(surface.normal, first)}; }
    Far far(Index j) const { return {surface.delta[j] >= smallest_delta ? Real(1) : Real(0)}; }
    bool ignores(const Far& j) const { return j.covers == 0; }
    void add(const Near& i, const Far&, const Pair& pair, Sum& sum) const
    {
        const Lanes above = -dot(pair.offset, i.normal);
        const LaneMask covers = (above > 0.0) & (above * above > (0.76 * 0.76) * pair.square);
        sum.cover += select(covers, pair.volume_kernel, 0.0);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0) continue;
            const double neighbours = sum.cover[lane] / volume_at_spacing;
            const bool in_band = surface.delta[i] >= smallest_delta;
            exposure[i] = in_band ? std::clamp((0.75 - neighbours) / 0.5, 0.0, 1.0) : 0.0;
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
