#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Continuity equation:
///
///   dρ_i/dt = ρ_i Σ_j V_j (v_i − v_j)·∇W_ij      [kg/(m³ s)]
///
/// This is the rate of Σ_j m_j W_ij: where particles crowd, density rises and pressure drives them apart. A gradient
/// corrected to be exact for linear fields would lose that tie: a shear flow has then no divergence however its
/// particles lie, and in a closed layer the packing drifts from the density (1.6 % of the depth in a quarter of a
/// turn). The price: rows that slide past each other breathe, and a stiff pressure answers with drag, which shows where
/// the sound speed is hundreds of times the flow's (validation_cases/marangoni_layer/README.md). Walls and solids take
/// part with their extrapolated velocity.
struct Continuity
{
    Mobility mobility;
    const ScalarField& density;
    const VectorField& velocity;
    ScalarField& density_rate;

    using Near = Of<Lanes, quantity::Density, quantity::Velocity>;
    using Far = Of<Real, quantity::Velocity>;
    struct Sum
    {
        Lanes divergence{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const { return {lanes(density, first), lanes(velocity, first)}; }
    Far far(Index j) const { return {real(velocity[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.divergence += dot(i.velocity - broadcast(j.velocity), pair.volume_gradient);
    }
    void store(const Cluster& cluster, const Near& i, const Sum& sum) const
    {
        store_if(density_rate, cluster, i.density * sum.divergence, [&](Index k) { return mobility.weight[k] != 0.0; });
    }
};

} // namespace cupel::inline CUPEL_ENGINE
