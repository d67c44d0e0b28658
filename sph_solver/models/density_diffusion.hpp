#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Density diffusion (Antuono, Colagrossi, Marrone 2012, the δ-SPH scheme), beside what continuity gives:
///
///   dρ_i/dt  = δ h c₀ Σ_j 2 V_j ψ_ij·∇W_ij                                                       [kg/(m³ s)]
///   ψ_ij     = [(ρ_j − ρ_i)/r − ½(⟨∇ρ⟩_i + ⟨∇ρ⟩_j)·e_ji] e_ji,   e_ji = (x_j − x_i)/r
///
/// Between liquid particles; walls and solids take no part.
struct DensityDiffusion
{
    Mobility mobility;
    const ScalarField& volume;
    const ScalarField& density;
    const VectorField& density_gradient;
    double diffusivity; ///< δ h c₀, m²/s
    ScalarField& density_rate;

    struct Near
    {
        Lanes density;
        VectorLanes density_gradient;
    };
    struct Far
    {
        Real weight, density; ///< weight: 2 V_j of liquid
        VectorOf<Real> density_gradient;
    };
    struct Sum
    {
        Lanes diffusion{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const { return {lanes(density, first), lanes(density_gradient, first)}; }
    Far far(Index j) const
    {
        return {real(2.0 * volume[j] * mobility.weight[j]), real(density[j]), real(density_gradient[j])};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        // offset = x_i − x_j, so e_ji·∇W = −(dW/dr) and (ρ_j − ρ_i)/r e_ji·∇W = −(ρ_j − ρ_i) gradient_over_r.
        const Lanes jump =
            j.density - i.density + 0.5 * dot(i.density_gradient + broadcast(j.density_gradient), pair.offset);
        sum.diffusion -= j.weight * pair.gradient_over_r * jump;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane)
            if (mobility.weight[cluster.first + lane] != 0.0)
                density_rate[cluster.first + lane] = diffusivity * sum.diffusion[lane];
    }
};

} // namespace cupel::inline CUPEL_ENGINE
