#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Density diffusion (Antuono, Colagrossi, Marrone 2012, the δ-SPH scheme), beside what continuity gives:
///
///   dρ_i/dt  = δ h c₀ Σ_j 2 V_j ψ_ij·∇W_ij                                                       [kg/(m³ s)]
///   ψ_ij     = [(ρ_j − ρ_i)/r − ½(⟨∇ρ⟩_i + ⟨∇ρ⟩_j)·e_ji] e_ji,   e_ji = (x_j − x_i)/r
///
/// Between liquid particles; walls and solids take no part. ⟨∇ρ⟩ may be that of the places before the last drift: the
/// term is small, and published schemes keep all of it for a whole Runge-Kutta step.
template <bool with_walls = true> struct DensityDiffusion
{
    Mobility mobility;
    const ScalarField& density;
    const VectorField& density_gradient;
    double diffusivity; ///< δ h c₀, m²/s
    ScalarField& density_rate;

    template <class Scalar> struct HalfDensityGradient
    {
        VectorOf<Scalar> half_density_gradient; ///< ½⟨∇ρ⟩, kg/m⁴
    };
    using Near = Of<Lanes, quantity::Density, HalfDensityGradient>;
    using Far = std::conditional_t<with_walls, Of<Real, quantity::Liquid, quantity::Density, HalfDensityGradient>,
                                   Of<Real, quantity::Density, HalfDensityGradient>>;
    struct Sum
    {
        Lanes diffusion{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const { prefetch_all(first, density_gradient, density_rate); }
    Near near(Index first) const { return {lanes(density, first), Lanes(0.5) * lanes(density_gradient, first)}; }
    Far far(Index j) const
    {
        if constexpr (with_walls)
            return {real(mobility.weight[j]), real(density[j]), real(0.5 * density_gradient[j])};
        else
            return {real(density[j]), real(0.5 * density_gradient[j])};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        // offset = x_i − x_j, so e_ji·∇W = −(dW/dr) and (ρ_j − ρ_i)/r e_ji·∇W = −(ρ_j − ρ_i) gradient_over_r.
        const Lanes jump =
            j.density - i.density + dot(i.half_density_gradient + broadcast(j.half_density_gradient), pair.offset);
        if constexpr (with_walls)
            sum.diffusion -= (j.liquid * pair.volume_gradient_over_r) * jump;
        else
            sum.diffusion -= pair.volume_gradient_over_r * jump;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        store_lanes(density_rate, cluster.first, mobility.moving_in(cluster), Lanes(2.0 * diffusivity) * sum.diffusion);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
