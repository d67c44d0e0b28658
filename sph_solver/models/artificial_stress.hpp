#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Artificial stress against clumping (Monaghan 2000, Gray, Monaghan, Swift 2001; the paper, section 2.3.2):
///
///   m_i dv_i/dt = −Σ_j m_i m_j f_ij⁴ (R_i + R_j) ∇W_ij,   f_ij = W(r_ij)/W(Δp),   R = ε |p|/ρ²      [N]
///
/// The paper takes ε = 0.2 for tension and compression alike.
struct ArtificialStress
{
    Mobility mobility;
    double strength;          ///< ε
    double kernel_at_spacing; ///< W(Δp)
    const ScalarField& mass;
    const ScalarField& density;
    const ScalarField& pressure;
    VectorField& force;

    template <class Scalar> struct Stress
    {
        Scalar stress; ///< R, Pa m⁶/kg²
    };
    using Near = Of<Lanes, quantity::Mass, Stress>;
    /// Of what stands a mass of zero.
    using Far = Of<Real, quantity::Mass, Stress>;
    struct Sum
    {
        VectorLanes force{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const
    {
        const Lanes p = lanes(pressure, first), rho = lanes(density, first);
        return {lanes(mass, first), strength * maximum(p, -p) / (rho * rho)};
    }
    Far far(Index j) const
    {
        return {real(mobility.weight[j] * mass[j]), real(strength * std::abs(pressure[j]) / (density[j] * density[j]))};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes closeness = pair.kernel / kernel_at_spacing;
        const Lanes fourth = closeness * closeness * (closeness * closeness);
        sum.force -= (i.mass * j.mass * fourth * (i.stress + j.stress) * pair.gradient_over_r) * pair.offset;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane)
            if (const Index i = cluster.first + lane; mobility.weight[i] != 0.0)
                force.set(i, force[i] + Vector{sum.force.x[lane], sum.force.y[lane], sum.force.z[lane]});
    }
};

} // namespace cupel::inline CUPEL_ENGINE
