#pragma once

#include <type_traits>

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
/// between liquid particles to round-off. For the books, what walls and solids press by the pressure that they are
/// given: −Σ_w V_i V_w p_w ∇W_iw [N]. Its work no compression of liquid answers, and what pressure does beside it the
/// continuity equation takes. Shifting keeps the arrangement even, which the second sum relies on.
template <bool with_walls = true> struct FreeSurfaceMomentum
{
    Mobility mobility;
    const ScalarField& volume;
    const ScalarField& pressure;
    const VectorField& velocity;
    double viscosity; ///< μ of the liquid, Pa·s
    VectorField& pressure_force;
    VectorField& viscous_force;
    VectorField& wall_force; ///< of pressure_force, what walls and solids press, N

    using Near = Of<Lanes, quantity::Pressure, quantity::Velocity>;
    using Far = std::conditional_t<with_walls, Of<Real, quantity::Liquid, quantity::Pressure, quantity::Velocity>,
                                   Of<Real, quantity::Pressure, quantity::Velocity>>;
    struct Sum
    {
        VectorLanes push{}, drag{};
        [[no_unique_address]] std::conditional_t<with_walls, VectorLanes, Nothing> walls{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const
    {
        prefetch_all(first, mobility.weight, volume, pressure, velocity, pressure_force, viscous_force, wall_force);
    }
    Near near(Index first) const { return {lanes(pressure, first), lanes(velocity, first)}; }
    Far far(Index j) const
    {
        if constexpr (with_walls)
            return {real(mobility.weight[j]), real(pressure[j]), real(velocity[j])};
        else
            return {real(pressure[j]), real(velocity[j])};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.push -= (i.pressure + j.pressure) * pair.volume_gradient;
        sum.drag += pair.volume_gradient_over_r * (i.velocity - broadcast(j.velocity));
        if constexpr (with_walls)
            if (j.liquid == 0) sum.walls -= Lanes(j.pressure) * pair.volume_gradient;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const unsigned liquid = mobility.moving_in(cluster);
        const Lanes volume_i = lanes(volume, cluster.first);
        store_lanes(pressure_force, cluster.first, liquid, volume_i * sum.push);
        store_lanes(viscous_force, cluster.first, liquid, (Lanes(2.0 * viscosity) * volume_i) * sum.drag);
        if constexpr (with_walls)
            store_lanes(wall_force, cluster.first, liquid, volume_i * sum.walls);
        else
            store_lanes(wall_force, cluster.first, liquid, VectorLanes{});
    }
};

/// Pressure and viscous force between two phases (Hu & Adams 2006, Adami, Hu, Adams 2013):
///
///   m_i dv_i/dt = −Σ_j (V_i² p_i + V_j² p_j) ∇W_ij + Σ_j μ_ij (V_i² + V_j²) (1/r dW/dr) (v_i − v_j)      [N]
///   μ_ij = 2 μ_i μ_j/(μ_i + μ_j)
///
/// The first sum is the derivative of the elastic energy Σ E(V), V = 1/Σ W (Hu & Adams 2006, eq. 14): what pressure
/// gives compression has. A mean pressure weighted by densities, which makes acceleration steady through an interface
/// (Hu & Adams 2007; Adami, Hu, Adams 2013), is no such derivative where densities differ: between air and water it
/// gave to motion twice what surface tension did, without end. Walls: wall_compression.hpp. A wall has no viscosity of
/// its own: it has that of the particle that meets it (Adami, Hu, Adams 2012).
struct TwoPhaseMomentum
{
    Mobility mobility;
    const ScalarField& volume;
    const ScalarField& pressure;
    const ScalarField& viscosity;
    const VectorField& velocity;
    VectorField& pressure_force;
    VectorField& viscous_force;

    struct Near
    {
        Lanes volume, pressure, viscosity;
        VectorLanes velocity;
    };
    struct Far
    {
        Real liquid, volume, pressure, viscosity; ///< liquid: 1 or 0
        VectorOf<Real> velocity;
    };
    struct Sum
    {
        VectorLanes pressure{}, viscous{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const
    {
        return {lanes(volume, first), lanes(pressure, first), lanes(viscosity, first), lanes(velocity, first)};
    }
    Far far(Index j) const
    {
        return {real(mobility.weight[j]), real(volume[j]), real(pressure[j]), real(viscosity[j]), real(velocity[j])};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes square_i = i.volume * i.volume, square_j = Lanes(j.volume * j.volume);
        const Lanes weight = (square_i + square_j) * pair.gradient_over_r;
        const Lanes viscosity_j = j.liquid == 0 ? i.viscosity : Lanes(j.viscosity);
        const Lanes mean_viscosity = 2.0 * i.viscosity * viscosity_j / (i.viscosity + viscosity_j);
        sum.pressure -= ((square_i * i.pressure + square_j * j.pressure) * pair.gradient_over_r) * pair.offset;
        sum.viscous += (weight * mean_viscosity) * (i.velocity - broadcast(j.velocity));
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const unsigned liquid = mobility.moving_in(cluster);
        store_lanes(pressure_force, cluster.first, liquid, sum.pressure);
        store_lanes(viscous_force, cluster.first, liquid, sum.viscous);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
