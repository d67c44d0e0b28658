#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The plain weakly compressible step: continuity, pressure and viscosity of one liquid in one pass, which shares what
/// the three need of a pair (Colagrossi, Landrini 2003; Morris, Fox, Zhu 1997, eq. 22):
///
///   dρ_i/dt = ρ_i Σ_j V_j (v_i − v_j)·∇W_ij                                                        [kg/(m³ s)]
///   dv_i/dt = (1/ρ_i) Σ_j V_j [ −(p_i + p_j) ∇W_ij + 2 μ (1/r dW/dr) (v_i − v_j) ]                 [m/s²]
///
/// The solver's flows take these sums one after the other, density first; this one is for benchmarks and for other
/// codes to be measured against.
struct PlainFlow
{
    const ScalarField& density;
    const ScalarField& pressure;
    const VectorField& velocity;
    double viscosity; ///< μ, Pa·s
    ScalarField& density_rate;
    VectorField& acceleration;

    using Near = Of<Lanes, quantity::Pressure, quantity::Velocity>;
    using Far = Of<Real, quantity::Pressure, quantity::Velocity>;
    struct Sum
    {
        Lanes divergence{};
        VectorLanes push{}, drag{};
    };

    bool idle(const Cluster&) const { return false; }
    Near near(Index first) const { return {lanes(pressure, first), lanes(velocity, first)}; }
    Far far(Index j) const { return {real(pressure[j]), real(velocity[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const VectorLanes difference = i.velocity - broadcast(j.velocity);
        sum.divergence += pair.volume_gradient_over_r * dot(difference, pair.offset);
        sum.push -= ((i.pressure + j.pressure) * pair.volume_gradient_over_r) * pair.offset;
        sum.drag += pair.volume_gradient_over_r * difference;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const Lanes rho = lanes(density, cluster.first);
        store_lanes(density_rate, cluster.first, cluster.lanes(), rho * sum.divergence);
        store_lanes(acceleration, cluster.first, cluster.lanes(),
                    (1.0 / rho) * (sum.push + Lanes(2.0 * viscosity) * sum.drag));
    }
};

} // namespace cupel::inline CUPEL_ENGINE
