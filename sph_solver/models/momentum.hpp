#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Pressure and viscous force on a liquid with a free surface:
///
///   m_i dv_i/dt = −Σ_j V_i V_j (p_i + p_j) ∇W_ij + Σ_j 2 μ V_i V_j (1/r dW/dr) (v_i − v_j)      [N]
///
/// The first sum is the variational partner of the continuity equation (Colagrossi et al. 2009: consistent at a free
/// surface, where p → 0); the second is Morris, Fox, Zhu 1997, eq. 22, to which viscous_traction.hpp adds what it lacks
/// at a free surface. Both are antisymmetric: they conserve momentum
/// between liquid particles to round-off. For the books, what pressure does against walls and solids, which liquid
/// meets with an extrapolated pressure and velocity: −Σ_w V_i V_w (p_w v_i + p_i v_w)·∇W_iw [W], the part of pressure's
/// work that no compression of liquid answers. Shifting keeps the arrangement even, which the second sum relies on.
struct FreeSurfaceMomentum
{
    Mobility mobility;
    const ScalarField& volume;
    const ScalarField& pressure;
    const VectorField& velocity;
    double viscosity; ///< μ of the liquid, Pa·s
    VectorField& pressure_force;
    VectorField& viscous_force;
    ScalarField& wall_power; ///< W

    struct Near
    {
        Lanes volume, pressure;
        VectorLanes velocity;
    };
    struct Far
    {
        Real liquid, volume, pressure; ///< liquid: 1 or 0
        VectorOf<Real> velocity;
    };
    struct Sum
    {
        VectorLanes pressure{}, viscous{};
        Lanes wall_power{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const { return {lanes(volume, first), lanes(pressure, first), lanes(velocity, first)}; }
    Far far(Index j) const { return {real(mobility.weight[j]), real(volume[j]), real(pressure[j]), real(velocity[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes weight = i.volume * j.volume * pair.gradient_over_r;
        sum.pressure -= (weight * (i.pressure + j.pressure)) * pair.offset;
        sum.viscous += (2.0 * viscosity * weight) * (i.velocity - broadcast(j.velocity));
        if (j.liquid == 0)
            sum.wall_power -= weight * (j.pressure * dot(i.velocity, pair.offset) +
                                        i.pressure * dot(broadcast(j.velocity), pair.offset));
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const auto liquid = [&](Index i) { return mobility.weight[i] != 0.0; };
        store_if(pressure_force, cluster, sum.pressure, liquid);
        store_if(viscous_force, cluster, sum.viscous, liquid);
        store_if(wall_power, cluster, sum.wall_power, liquid);
    }
};

/// Pressure and viscous force between two phases (Hu & Adams 2006, Adami, Hu, Adams 2013):
///
///   m_i dv_i/dt = −Σ_j (V_i² + V_j²) p̃_ij ∇W_ij + Σ_j μ_ij (V_i² + V_j²) (1/r dW/dr) (v_i − v_j)      [N]
///   p̃_ij = (ρ_j p_i + ρ_i p_j)/(ρ_i + ρ_j),   μ_ij = 2 μ_i μ_j/(μ_i + μ_j)
///
/// A wall has no density and no viscosity of its own: it has those of the particle that meets it (Adami, Hu, Adams
/// 2012). With the drop's, air before a wall would feel its own pressure twice and the wall's not at all, and swing
/// itself up against it. And the transport velocity of a background pressure p_b = β ρ_i c₀², which moves positions and
/// not momentum:
///
///   δu_i = −½ Δt_a β c₀²/V_i Σ_j (V_i² + V_j²) ∇W_ij,   Δt_a = 0.4 Δx/c₀      [m/s]
///
/// For the books, what pressure does beyond the compression that it takes, since p̃ is no derivative of an energy where
/// densities differ, and since walls yield nothing: F_p,i·v_i + p_i V_i² Σ_j (v_i − v_j)·∇W_ij [W].
///
/// As published Δt_a is the time step and β one; this one does not change with what else limits the step, and with the
/// particle's own density as heavy and light phases differ.
struct TwoPhaseMomentum
{
    Mobility mobility;
    const ScalarField& volume;
    const ScalarField& density;
    const ScalarField& pressure;
    const ScalarField& viscosity;
    const VectorField& velocity;
    double transport; ///< ½ Δt_a β c₀² = 0.2 β c₀ Δx, m²/s
    VectorField& pressure_force;
    VectorField& viscous_force;
    ScalarField& imbalance; ///< W
    VectorField& transport_velocity;

    struct Near
    {
        Lanes volume, density, pressure, viscosity;
        VectorLanes velocity;
    };
    struct Far
    {
        Real liquid, volume, density, pressure, viscosity; ///< liquid: 1 or 0
        VectorOf<Real> velocity;
    };
    struct Sum
    {
        VectorLanes pressure{}, viscous{}, unevenness{};
        Lanes divergence{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const
    {
        return {lanes(volume, first), lanes(density, first), lanes(pressure, first), lanes(viscosity, first),
                lanes(velocity, first)};
    }
    Far far(Index j) const
    {
        return {real(mobility.weight[j]), real(volume[j]),    real(density[j]),
                real(pressure[j]),        real(viscosity[j]), real(velocity[j])};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes weight = (i.volume * i.volume + j.volume * j.volume) * pair.gradient_over_r;
        const bool wall = j.liquid == 0;
        const Lanes density_j = wall ? i.density : Lanes(j.density);
        const Lanes viscosity_j = wall ? i.viscosity : Lanes(j.viscosity);
        const Lanes mean_pressure = (density_j * i.pressure + i.density * j.pressure) / (i.density + density_j);
        const Lanes mean_viscosity = 2.0 * i.viscosity * viscosity_j / (i.viscosity + viscosity_j);
        sum.pressure -= (weight * mean_pressure) * pair.offset;
        const VectorLanes difference = i.velocity - broadcast(j.velocity);
        sum.viscous += (weight * mean_viscosity) * difference;
        sum.divergence += pair.gradient_over_r * dot(wall ? i.velocity : difference, pair.offset);
        sum.unevenness += weight * pair.offset;
    }
    void store(const Cluster& cluster, const Near& i, const Sum& sum) const
    {
        const auto liquid = [&](Index k) { return mobility.weight[k] != 0.0; };
        store_if(pressure_force, cluster, sum.pressure, liquid);
        store_if(viscous_force, cluster, sum.viscous, liquid);
        store_if(imbalance, cluster, dot(sum.pressure, i.velocity) + i.pressure * i.volume * i.volume * sum.divergence,
                 liquid);
        store_if(transport_velocity, cluster, (-transport / i.volume) * sum.unevenness, liquid);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
