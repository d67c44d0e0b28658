#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Monaghan's artificial viscosity (Monaghan 1992; the paper, section 2.3.1), for pairs that approach each other:
///
///   m_i dv_i/dt = −Σ_j m_i m_j Π_ij ∇W_ij,   Π_ij = (−α c₀ φ_ij + β φ_ij²)/ρ̄_ij,
///   φ_ij = h v_ij·r_ij/(r_ij² + 0.01 h²)      [N]
struct ArtificialViscosity
{
    Mobility mobility;
    double linear;           ///< α
    double quadratic;        ///< β
    double sound_speed;      ///< c₀, m/s
    double smoothing_length; ///< h, m
    const ScalarField& mass;
    const ScalarField& density;
    const VectorField& velocity;
    VectorField& force;

    using Near = Of<Lanes, quantity::Mass, quantity::Density, quantity::Velocity>;
    /// Of what stands a mass of zero.
    using Far = Of<Real, quantity::Mass, quantity::Density, quantity::Velocity>;
    struct Sum
    {
        VectorLanes force{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const { return {lanes(mass, first), lanes(density, first), lanes(velocity, first)}; }
    Far far(Index j) const { return {real(mobility.weight[j] * mass[j]), real(density[j]), real(velocity[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const double h = smoothing_length;
        const Lanes approach = minimum(dot(i.velocity - broadcast(j.velocity), pair.offset), Lanes{});
        const Lanes phi = h * approach / (pair.square + 0.01 * h * h);
        const Lanes viscous_pressure =
            2.0 * (quadratic * phi * phi - linear * sound_speed * phi) / (i.density + j.density);
        sum.force -= (i.mass * j.mass * viscous_pressure * pair.gradient_over_r) * pair.offset;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane)
            if (const Index i = cluster.first + lane; mobility.weight[i] != 0.0)
                force.set(i, force[i] + Vector{sum.force.x[lane], sum.force.y[lane], sum.force.z[lane]});
    }
};

} // namespace cupel::inline CUPEL_ENGINE
