#pragma once

#include <algorithm>
#include <cmath>

#include "models/colour_profile.hpp"
#include "models/surface_geometry.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Wetting of a wall, flat or round: what the wall's particles show of the surface that meets it, and what the
/// surface's angle is.
///
/// A wall particle near the contact line shows the interface as it goes on beyond the wall's plane: its normal n̂_w, the
/// signed depth s below it, and with that the colour c = clamp(½ + s/Δx) and the weight δ = w(s). It then takes part in
/// the smoothing of normals and in the curvature fit like any particle of the band, and the liquid's own normals are
/// never overwritten. In the wall's plane the normal is what Young's equation asks for,
///
///   n̂_Y = sin θ_Y t̂ + cos θ_Y N,      t̂ the lateral direction of −∇c in the liquid's surface band, N the wall's
///   normal.
///
/// Means ⟨ ⟩ are over the band near the wall, of weight W_wj δ_j; f = ⟨x_j + s_j n̂_j⟩ is a place of the interface, and
/// m̂ the mean of n̂_Y and the liquid's mean normal: on a circle the plane through f across m̂ meets the wall's where the
/// circle does.
///
///   Two liquids: from there, with n̂_Y, the circle of the liquid's curvature κ_m. The wall's layers all with n̂_Y would
///   say that curvature ends at the wall, and the drop spreads: by 1.3° at 90°, whatever the resolution.
///   A free surface up to 90°:   n̂_w = n̂_Y,   s = (f − x_w)·m̂      [m]. A drop of 45° stirs its edge else.
///   A free surface that overhangs (θ_Y above 90°): the normals beside a wall are in part what the wall's colours make
///   them; continued by what they say, the interface in the wall follows what it has brought about itself (of a drop of
///   120° it stood at 135° in the wall, and normals beside it at 138°). There it is the circle through f with κ_m and
///   with the normal that Young's angle in the wall's plane gives it,   n̂·N = cos θ_Y + κ_m ⟨d_j⟩.   With n̂_Y in all
///   layers a drop of 150° spreads by 4.7° with 40 spacings a diameter.
///
/// Where a circle closes below the wall, so does what the wall shows. N is that of the place at which the interface
/// meets the wall, which on a round one is not that of the wall particle that looks: from there the line through f
/// across m̂ meets the wall's surface. The sums are therefore of vectors, and N comes in when they are complete.
///
/// The angle at which the surface meets the wall, continued to it from the mean height d above the wall's plane there
/// by the curvature κ_m along the meridian (κ in the plane, ½κ in space as on a cap; κ is of the step before):
///
///   cos θ = ⟨n̂_j·N⟩ − κ_m ⟨d_j⟩
///
/// What it differs from θ_Y by pulls at the contact line (ContactPull). Sums are taken for the wall's surface layer.
/// Melt on its own solid has no such line to correct: there the metal's surface is followed as one (metal_surface.hpp).
/// Source: own derivation after the normal correction of Breinlinger et al. 2013, which the paper uses (section 2.5.2).
struct WallInterface
{
    Mobility mobility;
    double reach;            ///< liquid further than this from the wall is not asked, m
    double smallest_delta;   ///< 1/m
    double smallest_lateral; ///< of −∇c, 1/m
    const Particles& particles;
    const VectorField& wall_normal;
    SurfaceFields surface;
    const ScalarField& curvature; ///< κ, of the step before, 1/m
    ScalarField& weight_sum;      ///< Σ W δ
    VectorField& normal_sum;      ///< Σ W δ n̂
    VectorField& place_sum;       ///< Σ W δ (x − x_w)
    ScalarField& curvature_sum;   ///< Σ W δ κ
    VectorField& foot_sum;        ///< Σ W δ (x + s n̂ − x_w)
    VectorField& lateral_sum;     ///< Σ W δ t̂
    ScalarField& primary_sum;     ///< Σ W over the primary liquid and its solid
    ScalarField& other_sum;       ///< Σ W over the surrounding

    struct Near
    {
        VectorLanes wall_normal;
    };
    struct Far
    {
        Real metal, primary, delta, depth, curvature; ///< metal: not of a wall; primary: 1 or 0
        VectorOf<Real> colour_gradient, normal;
    };
    struct Sum
    {
        Lanes weight{}, curvature{}, primary{}, other{};
        VectorLanes normal{}, place{}, lateral{}, foot{};
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
    Near near(Index first) const { return {lanes(wall_normal, first)}; }
    Far far(Index j) const
    {
        const auto k = static_cast<std::size_t>(j);
        return {particles.kind[k] == Kind::wall ? Real(0) : Real(1),
                particles.material[k] == 0 ? Real(1) : Real(0),
                mobility.weight[j] != 0.0 ? real(surface.delta[j]) : Real(0),
                real(surface.depth[j]),
                real(curvature[j]),
                real(surface.colour_gradient[j]),
                real(surface.normal[j])};
    }
    bool ignores(const Far& j) const { return j.metal == 0; }
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
        sum.weight += weight;
        sum.normal += weight * broadcast(j.normal);
        sum.place -= weight * pair.offset;
        sum.curvature += weight * j.curvature;
        sum.foot += weight * (broadcast(j.depth * j.normal) - pair.offset);
        sum.lateral += (weight / (length + 1e-30)) * along;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const unsigned chosen = lanes_where(cluster, [&](Index i) { return stands_for_surface(i); });
        store_lanes(weight_sum, cluster.first, chosen, sum.weight);
        store_lanes(normal_sum, cluster.first, chosen, sum.normal);
        store_lanes(place_sum, cluster.first, chosen, sum.place);
        store_lanes(curvature_sum, cluster.first, chosen, sum.curvature);
        store_lanes(foot_sum, cluster.first, chosen, sum.foot);
        store_lanes(lateral_sum, cluster.first, chosen, sum.lateral);
        store_lanes(primary_sum, cluster.first, chosen, sum.primary);
        store_lanes(other_sum, cluster.first, chosen, sum.other);
    }
};

/// The force of Young's equation at a contact line, σ (cos θ_Y − cos θ) a length along the wall, as a force density in
/// the liquid's surface band near the wall:
///
///   f = σ (cos θ_Y − cos θ) sin θ δ(s) δ_w(d) t̂,   δ_w = (1 − d/(2Δx))/Δx below a distance of d = 2Δx      [N/m³]
///
/// (the contact line force of Huber, Keller, Säckel, Hirschler, Kunz, Hassanizadeh, Nieken 2016). δ(s) and δ_w(d) have
/// the integral one across the surface and the wall, which meet at θ: so does sin θ δ δ_w over the plane across the
/// line. Sums take what the wall's surface layer knows, the more the more of the surface it sees.
/// Not under a free surface that overhangs (θ_Y above 90°): of the few particles in its wedge those of the second layer
/// have normals that miss by up to 18°, and the pull feeds what makes them do so. A particle above the wall that juts
/// out lets the surface below it look steeper, for which it is pulled out further. There the curvature that the wall's
/// normals bring about turns the surface alone.
struct ContactPull
{
    Mobility mobility;
    double spacing; ///< Δx, m
    const VectorField& wall_normal;
    const ScalarField& wall_depth;
    const ScalarField& weight_sum; ///< Σ W δ of a wall particle
    const VectorField& wall_pull;  ///< (cos θ_Y − cos θ) sin θ t̂ in the wall's surface layer
    VectorField& pull;             ///< f/(σ δ), 1/m

    struct Near
    {};
    struct Far
    {
        Real weight, depth;
        VectorOf<Real> normal, pull;
    };
    struct Sum
    {
        Lanes weight{}, distance{};
        VectorLanes pull{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index) const { return {}; }
    Far far(Index j) const
    {
        const Vector p = wall_pull[j];
        const bool counts = mobility.weight[j] == 0.0 && dot(p, p) > 0.0;
        return {counts ? real(weight_sum[j]) : Real(0), real(wall_depth[j]), real(wall_normal[j]), real(p)};
    }
    bool ignores(const Far& j) const { return j.weight == 0; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes weight = j.weight * pair.kernel;
        sum.weight += weight;
        sum.distance += weight * (dot(pair.offset, broadcast(j.normal)) - Lanes(j.depth));
        sum.pull += weight * broadcast(j.pull);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0 || !(sum.weight[lane] > 0.0)) continue;
            const double scale = 1.0 / sum.weight[lane], distance = std::max(0.0, scale * sum.distance[lane]);
            const double share = std::max(0.0, 1.0 - 0.5 * distance / spacing) / spacing;
            pull.set(i, (share * scale) * Vector{sum.pull.x[lane], sum.pull.y[lane], sum.pull.z[lane]});
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
