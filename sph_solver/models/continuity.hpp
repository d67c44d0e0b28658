#pragma once

#include "models/term.hpp"

namespace cupel
{

/// Continuity equation with density diffusion (Antuono, Colagrossi, Marrone 2012, the δ-SPH scheme):
///
///   dρ_i/dt = ρ_i Σ_j V_j (v_i − v_j)·∇W_ij + δ h c₀ Σ_j 2 V_j ψ_ij·∇W_ij                    [kg/(m³ s)]
///   ψ_ij    = [(ρ_j − ρ_i)/r − ½(⟨∇ρ⟩_i + ⟨∇ρ⟩_j)·e_ji] e_ji,   e_ji = (x_j − x_i)/r
///
/// The first sum is the rate of Σ_j m_j W_ij: where particles crowd, density rises and pressure drives them apart. A
/// gradient corrected to be exact for linear fields would lose that tie: a shear flow has then no divergence however
/// its particles lie, and in a closed layer the packing drifts from the density (1.6 % of the depth in a quarter of a
/// turn). The price: rows that slide past each other breathe, and a stiff pressure answers with drag, which shows where
/// the sound speed is hundreds of times the flow's (validation_cases/marangoni_layer/README.md). Walls and solids take
/// part in the first sum with their extrapolated velocity and not in the second.
struct Continuity
{
    Mobility mobility;
    const ScalarField& volume;
    const ScalarField& density;
    const VectorField& velocity;
    const VectorField& density_gradient;
    double diffusion; ///< δ h c₀, m²/s; 0 switches the diffusion off
    ScalarField& density_rate;

    struct Near
    {
        Lanes density;
        VectorLanes velocity, density_gradient;
    };
    struct Sum
    {
        Lanes divergence{}, diffusion{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const
    {
        return {density.lanes(first), velocity.lanes(first), density_gradient.lanes(first)};
    }
    void add(const Near& i, Index j, const Pair& pair, Sum& sum) const
    {
        const Lanes weight = volume[j] * pair.gradient_over_r;
        sum.divergence += weight * dot(i.velocity - broadcast(velocity[j]), pair.offset);
        const double liquid = mobility.weight[j];
        // offset = x_i − x_j, so e_ji·∇W = −(dW/dr) and (ρ_j − ρ_i)/r e_ji·∇W = −(ρ_j − ρ_i) gradient_over_r.
        const Lanes jump =
            density[j] - i.density + 0.5 * dot(i.density_gradient + broadcast(density_gradient[j]), pair.offset);
        sum.diffusion -= (2.0 * liquid) * weight * jump;
    }
    void store(const Cluster& cluster, const Near& i, const Sum& sum) const
    {
        store_if(density_rate, cluster, i.density * sum.divergence + diffusion * sum.diffusion,
                 [&](Index k) { return mobility.weight[k] != 0.0; });
    }
};

} // namespace cupel
