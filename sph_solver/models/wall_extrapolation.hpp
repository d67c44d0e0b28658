#pragma once

#include <algorithm>
#include <vector>

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Pressure of wall and solid particles, extrapolated from the liquid before them (Adami, Hu, Adams 2012, eq. 27; the
/// paper, section 2.4):
///
///   p_w = [Σ p_f W + (g − a_w) · Σ ρ_f r_wf W] / Σ W      [Pa]
///
/// Without a gas on the other side a wall does not pull: then p_w is kept at or above zero. Where the load on a free
/// surface is carried into the liquid (surface_pressure.hpp), a wall has its mean λ_w = Σ λ_f W / Σ W, p is what is
/// left of pressure without it, and it is p_w + λ_w that is kept at or above zero. Solid metal is of one piece with its
/// melt and may pull: else what melts would be thrown off by every positive pressure and held by no negative one.
struct WallPressure
{
    Mobility mobility;
    const ScalarField& density;
    Vector gravity; ///< m/s²
    const std::vector<Kind>& kind;
    ScalarField* carried_load; ///< λ, Pa; null where none is carried
    ScalarField& pressure;

    template <class Scalar> struct Load
    {
        Scalar load;
    };

    struct Near
    {};
    using Far = Of<Real, quantity::Liquid, quantity::Pressure, quantity::Density, Load>;
    struct Sum
    {
        Lanes weight{}, pressure{}, load{};
        VectorLanes head{};
    };

    bool idle(const Cluster& cluster) const { return mobility.all_in(cluster); }
    Near near(Index) const { return {}; }
    Far far(Index j) const
    {
        return {real(mobility.weight[j]), real(pressure[j]), real(density[j]),
                carried_load ? real((*carried_load)[j]) : Real(0)};
    }
    bool ignores(const Far& j) const { return j.liquid == 0; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.weight += pair.kernel;
        sum.pressure += j.pressure * pair.kernel;
        sum.load += j.load * pair.kernel;
        sum.head += (j.density * pair.kernel) * pair.offset;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] != 0.0) continue;
            const double weight = sum.weight[lane];
            const Vector head{sum.head.x[lane], sum.head.y[lane], sum.head.z[lane]};
            const double extrapolated = weight > 0.0 ? (1.0 / weight) * (sum.pressure[lane] + dot(gravity, head)) : 0.0;
            const bool may_pull = kind[static_cast<std::size_t>(i)] == Kind::solid;
            const double load = weight > 0.0 ? sum.load[lane] / weight : 0.0;
            if (carried_load) (*carried_load)[i] = load;
            pressure[i] = may_pull ? extrapolated : std::max(-load, extrapolated);
        }
    }
};

/// Velocity of wall and solid particles, extrapolated likewise (Adami, Hu, Adams 2012, eq. 23):
///
///   v_w = 2 v_wall − ṽ, ṽ = Σ v_f W / Σ W   (no slip);   v_w = ṽ − 2 (ṽ·n) n   (free slip)      [m/s]
///
/// Along a flat wall without slip the extrapolation is linear in the distance: what ṽ says at the mean distance d̃ of
/// the liquid that is seen holds at that distance, not at the depth d_w of the wall particle,
///
///   (v_w − v_wall)_t = −min(d_w/d̃, 3) (ṽ − v_wall)_t,   d̃ = Σ d_f W / Σ W
///
/// (Morris, Fox, Zhu 1997, eq. 26, with a limit against noise; with it the wall of a shear flow is where it should be,
/// without it the second layer gives a third of its stress). Solids have no such plane and edges none of their own:
/// there the ratio is one.
struct WallVelocity
{
    Mobility mobility;
    const VectorField* wall_normal; ///< null where the scene has only solids
    const ScalarField* free_slip;
    const ScalarField* wall_depth;    ///< d_w, m; 0 where no plane is meant
    const VectorField* wall_velocity; ///< v_wall, m/s; null where all walls are at rest
    VectorField& velocity;

    struct Near
    {};
    using Far = Of<Real, quantity::Liquid, quantity::Velocity>;
    struct Sum
    {
        Lanes weight{};
        VectorLanes velocity{}, away{}; ///< away: Σ (x_w − x_f) W
    };

    bool idle(const Cluster& cluster) const { return mobility.all_in(cluster); }
    Near near(Index) const { return {}; }
    Far far(Index j) const { return {real(mobility.weight[j]), real(velocity[j])}; }
    bool ignores(const Far& j) const { return j.liquid == 0; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.weight += pair.kernel;
        sum.velocity += pair.kernel * broadcast(j.velocity);
        sum.away += pair.kernel * pair.offset;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] != 0.0) continue;
            if (!(sum.weight[lane] > 0.0)) {
                velocity.set(i, {});
                continue;
            }
            const double scale = 1.0 / sum.weight[lane];
            const Vector mean{scale * sum.velocity.x[lane], scale * sum.velocity.y[lane], scale * sum.velocity.z[lane]};
            if (free_slip && (*free_slip)[i] != 0.0)
                velocity.set(i, mean - (2.0 * dot(mean, (*wall_normal)[i])) * (*wall_normal)[i]);
            else
                velocity.set(i, no_slip(i, mean, scale * Vector{sum.away.x[lane], sum.away.y[lane], sum.away.z[lane]}));
        }
    }

    Vector no_slip(Index i, const Vector& mean, const Vector& away) const
    {
        const Vector wall = wall_velocity ? (*wall_velocity)[i] : Vector{};
        const Vector slip = mean - wall;
        const double depth = wall_depth ? (*wall_depth)[i] : 0.0;
        if (depth == 0.0) return wall - slip;
        const Vector normal = (*wall_normal)[i];
        const double distance = -dot(away, normal) - depth;
        const double ratio = distance > 0.0 ? std::min(depth / distance, 3.0) : 3.0;
        const Vector across = dot(slip, normal) * normal;
        return wall - across - ratio * (slip - across);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
