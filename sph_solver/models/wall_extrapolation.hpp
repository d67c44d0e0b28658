#pragma once

#include <algorithm>
#include <vector>

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// State of wall and solid particles, extrapolated from the liquid before them (Adami, Hu, Adams 2012, eqs. 23 and 27;
/// the paper, section 2.4):
///
///   p_w = [Σ p_f W + (g − a_w) · Σ ρ_f r_wf W] / Σ W      [Pa]
///   v_w = 2 v_wall − Σ v_f W / Σ W   (no slip);   v_w = ṽ − 2 (ṽ·n) n, ṽ = Σ v_f W / Σ W   (free slip)      [m/s]
///
/// Walls are at rest here. Without a gas on the other side a wall does not pull: then p_w is kept at or above zero.
/// Solid metal is of one piece with its melt and may pull: else what melts would be thrown off by every positive
/// pressure and held by no negative one.
struct WallExtrapolation
{
    Mobility mobility;
    const ScalarField& density;
    Vector gravity;      ///< m/s²
    bool walls_may_pull; ///< two phases fill the space: a wall may take negative pressure
    const std::vector<Kind>& kind;
    const VectorField* wall_normal; ///< null where the scene has only solids
    const ScalarField* free_slip;
    ScalarField& pressure;
    VectorField& velocity;

    struct Near
    {};
    struct Far
    {
        Real liquid, pressure, density; ///< liquid: 1 or 0
        VectorOf<Real> velocity;
    };
    struct Sum
    {
        Lanes weight{}, pressure{};
        VectorLanes head{}, velocity{};
    };

    bool idle(const Cluster& cluster) const { return mobility.all_in(cluster); }
    Near near(Index) const { return {}; }
    Far far(Index j) const
    {
        return {real(mobility.weight[j]), real(pressure[j]), real(density[j]), real(velocity[j])};
    }
    bool ignores(const Far& j) const { return j.liquid == 0; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.weight += pair.kernel;
        sum.pressure += j.pressure * pair.kernel;
        sum.head += (j.density * pair.kernel) * pair.offset;
        sum.velocity += pair.kernel * broadcast(j.velocity);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] != 0.0) continue;
            if (!(sum.weight[lane] > 0.0)) {
                pressure[i] = 0.0;
                velocity.set(i, {});
                continue;
            }
            const double scale = 1.0 / sum.weight[lane];
            const Vector head{sum.head.x[lane], sum.head.y[lane], sum.head.z[lane]};
            const double extrapolated = scale * (sum.pressure[lane] + dot(gravity, head));
            const bool may_pull = walls_may_pull || kind[static_cast<std::size_t>(i)] == Kind::solid;
            pressure[i] = may_pull ? extrapolated : std::max(0.0, extrapolated);
            const Vector mean{scale * sum.velocity.x[lane], scale * sum.velocity.y[lane], scale * sum.velocity.z[lane]};
            if (free_slip && (*free_slip)[i] != 0.0)
                velocity.set(i, mean - (2.0 * dot(mean, (*wall_normal)[i])) * (*wall_normal)[i]);
            else
                velocity.set(i, -1.0 * mean);
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
