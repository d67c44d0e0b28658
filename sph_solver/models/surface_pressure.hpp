#pragma once

#include <algorithm>

#include "models/gradient_correction.hpp"
#include "models/surface_geometry.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The pressure that a free surface's load L = σκ + p_r puts the liquid under, carried from the surface into it:
///
///   ∇²λ = 0 in the liquid,   λ = L on its free surface,   ∂λ/∂n = 0 on walls and solids      [Pa]
///
/// Pressure is p = λ + p', and the equation of state has p' alone:   ρ Dv/Dt = −∇p' − ∇λ + …,   p' = 0 on the surface,
/// which is what SPH does at a free surface of itself. Where the load is everywhere the same, as on a drop at rest,
/// nothing is left to be balanced: λ is uniform, and no force, however its particles lie. A continuum surface force
/// leaves there the difference of two sums of the size of L/Δx, which feeds waves of the length of a spacing (a drop of
/// Laplace number 12 000: spurious capillary number 7e-3, with λ 5e-5). Where λ is harmonic p' stays near zero, and
/// with it what SPH's pressure does wrong at a surface (a gravity wave of 16 spacings is 4.5 % slow).
/// The equation holds for every λ that meets the condition on the surface, so that inside it may be relaxed as time
/// goes on, once a step:
///
///   λ_i ← Σ_j V_j w_ij [λ_j − ∇λ_i·(x_j − x_i)] / Σ_j V_j w_ij,   w = −(1/r) dW/dr
///
/// (about the particle's own place: a kernel that a surface cuts off has its centre further inside).
/// Particles of the surface's first layer, at the depth s, take λ_i = L_i − s n̂·∇λ_i instead, the more the more of
/// it is surface (share_of_surface), and no more than |L_i| away from L_i: a wave of number k falls off by k s L, less
/// than itself where it is resolved, and in a thin edge, whose two sides see each other, λ would run away. Walls and
/// solids have the mean of the liquid that they see (wall_extrapolation.hpp), a solid that is the surface of its metal
/// (metal_surface.hpp) the load that it has there. Own derivation.
struct SurfacePressure
{
    Mobility mobility;
    CorrectionMatrix correction;
    const ScalarField& value; ///< λ, Pa
    ScalarField& mean;        ///< its mean over neighbours, Pa
    VectorField& gradient;    ///< ∇λ, corrected to be exact where λ is linear, Pa/m

    struct Near
    {
        Lanes value;
    };
    struct Far
    {
        Real value;
    };
    struct Sum
    {
        Lanes weight{}, change{};
        VectorLanes gradient{}, moment{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const { prefetch_all(first, mobility.weight, correction, value, mean, gradient); }
    Near near(Index first) const { return {lanes(value, first)}; }
    Far far(Index j) const { return {real(value[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes& weight = pair.volume_gradient_over_r;
        const Lanes change = weight * (j.value - i.value);
        sum.weight += weight;
        sum.change += change;
        sum.gradient += change * pair.offset;
        sum.moment += weight * pair.offset;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const unsigned liquid = mobility.moving_in(cluster);
        const VectorLanes slope = correction.of_cluster(cluster.first) * sum.gradient;
        store_lanes(gradient, cluster.first, liquid, slope);
        const Lanes zero(0.0);
        const Lanes change = select(sum.weight < zero, (sum.change + dot(slope, sum.moment)) / sum.weight, zero);
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (liquid >> lane & 1u) mean[i] = value[i] + change[lane]; // added up from step to step, in double
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
