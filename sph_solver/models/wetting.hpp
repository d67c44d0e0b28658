#pragma once

#include <algorithm>
#include <cmath>

#include "models/colour_profile.hpp"
#include "models/surface_geometry.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Wetting of a flat wall by normals on the wall particles.
///
/// A wall particle near the contact line carries the normal that Young's equation asks for,
///
///   n̂_w = sin θ t̂ + cos θ N,      t̂ the lateral direction of −∇c in the liquid's surface band, N the wall's normal,
///
/// the signed depth s below the interface extrapolated to it, s = Σ W_wj δ_j (x_j + φ_j n̂_j − x_w)·n̂_w / Σ W_wj δ_j,
/// and with it the colour c = clamp(½ + s/Δx) and the weight δ = w(s). It then takes part in the smoothing of normals
/// and in the curvature fit like any particle of the band, and the liquid's own normals are never overwritten. Sums are
/// taken for the wall's surface layer; deeper layers continue it along the wall's normal: s + d cos θ.
/// Melt on its own solid has no such line to correct: there the metal's surface is followed as one, melt and solid
/// together, and the edge of a pool stands where the metal melts, as in a volume-of-fluid model.
/// Source: own derivation after the normal correction of Breinlinger et al. 2013, which the paper uses (section 2.5.2).
struct WallInterface
{
    Mobility mobility;
    double contact_angle;    ///< through the primary liquid, rad
    double reach;            ///< liquid further than this from the wall is not asked, m
    double smallest_delta;   ///< 1/m
    double smallest_lateral; ///< of −∇c, 1/m
    const Particles& particles;
    const VectorField& wall_normal;
    SurfaceFields surface;
    ScalarField& weight_sum;  ///< Σ W δ
    ScalarField& depth_sum;   ///< Σ W δ s
    VectorField& lateral_sum; ///< Σ W δ t̂
    ScalarField& primary_sum; ///< Σ W over the primary liquid
    ScalarField& other_sum;   ///< Σ W over the surrounding

    struct Near
    {
        VectorLanes position, wall_normal;
    };
    struct Far
    {
        Real liquid, primary, delta, depth; ///< liquid, primary: 1 or 0
        VectorOf<Real> colour_gradient, normal;
    };
    struct Sum
    {
        Lanes weight{}, depth{}, primary{}, other{};
        VectorLanes lateral{};
    };

    bool stands_for_surface(Index i) const
    {
        const auto k = static_cast<std::size_t>(i);
        return particles.surface_parent[k] == particles.identity[k];
    }
    bool idle(const Cluster& cluster) const
    {
        return none_in(cluster, [&](Index i) { return stands_for_surface(i); });
    }
    Near near(Index first) const { return {lanes(particles.position, first), lanes(wall_normal, first)}; }
    Far far(Index j) const
    {
        return {
            real(mobility.weight[j]),         particles.material[static_cast<std::size_t>(j)] == 0 ? Real(1) : Real(0),
            real(surface.delta[j]),           real(surface.depth[j]),
            real(surface.colour_gradient[j]), real(surface.normal[j])};
    }
    bool ignores(const Far& j) const { return j.liquid == 0; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        (j.primary != 0 ? sum.primary : sum.other) += pair.kernel;
        if (!(j.delta >= smallest_delta)) return;
        // Distance of j above the wall and the part of its colour gradient along the wall, lane by lane.
        const Lanes height = -dot(pair.offset, i.wall_normal);
        const VectorLanes gradient = broadcast(j.colour_gradient);
        const VectorLanes along = gradient - dot(gradient, i.wall_normal) * i.wall_normal;
        const Lanes length = square_root(dot(along, along));
        const LaneMask takes_part = (length > Lanes(smallest_lateral)) & (height < Lanes(reach));
        const Lanes weight = select(takes_part, j.delta * pair.kernel, 0.0);
        const VectorLanes lateral = (1.0 / (length + 1e-30)) * along;
        const VectorLanes prescribed =
            Lanes(std::sin(contact_angle)) * lateral + Lanes(std::cos(contact_angle)) * i.wall_normal;
        const VectorLanes foot = broadcast(j.depth * j.normal) - pair.offset;
        sum.weight += weight;
        sum.depth += weight * dot(foot, prescribed);
        sum.lateral += weight * lateral;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const auto chosen = [&](Index i) { return stands_for_surface(i); };
        store_if(weight_sum, cluster, sum.weight, chosen);
        store_if(depth_sum, cluster, sum.depth, chosen);
        store_if(lateral_sum, cluster, sum.lateral, chosen);
        store_if(primary_sum, cluster, sum.primary, chosen);
        store_if(other_sum, cluster, sum.other, chosen);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
