#pragma once

#include <type_traits>

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The force of pressure alone, for the shorter steps in which sound is followed while all else is held; the same sum
/// as in momentum.hpp, and the partner of continuity.hpp:
///
///   m_i dv_i/dt = −Σ_j V_i V_j (p_i + p_j) ∇W_ij      [N]
///
/// What walls and solids press as in FreeSurfaceMomentum, where there are any.
template <bool with_walls> struct PressureForce
{
    Mobility mobility;
    const ScalarField& volume;
    const ScalarField& pressure;
    VectorField& pressure_force;
    VectorField& wall_force; ///< N

    using Near = Of<Lanes, quantity::Pressure>;
    using Far =
        std::conditional_t<with_walls, Of<Real, quantity::Liquid, quantity::Pressure>, Of<Real, quantity::Pressure>>;
    struct Sum
    {
        VectorLanes push{};
        [[no_unique_address]] std::conditional_t<with_walls, VectorLanes, Nothing> walls{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const
    {
        prefetch_all(first, mobility.weight, volume, pressure, pressure_force, wall_force);
    }
    Near near(Index first) const { return {lanes(pressure, first)}; }
    Far far(Index j) const
    {
        if constexpr (with_walls)
            return {real(mobility.weight[j]), real(pressure[j])};
        else
            return {real(pressure[j])};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.push -= ((i.pressure + j.pressure) * pair.volume_gradient_over_r) * pair.offset;
        if constexpr (with_walls)
            if (j.liquid == 0) sum.walls -= Lanes(j.pressure) * pair.volume_gradient;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const unsigned liquid = mobility.moving_in(cluster);
        const Lanes volume_i = lanes(volume, cluster.first);
        store_lanes(pressure_force, cluster.first, liquid, volume_i * sum.push);
        if constexpr (with_walls)
            store_lanes(wall_force, cluster.first, liquid, volume_i * sum.walls);
        else
            store_lanes(wall_force, cluster.first, liquid, VectorLanes{});
    }
};

/// The force of pressure between two phases, the same sum as in TwoPhaseMomentum:
///
///   m_i dv_i/dt = −Σ_j (V_i² p_i + V_j² p_j) ∇W_ij      [N]
struct TwoPhasePressureForce
{
    Mobility mobility;
    const ScalarField& volume;
    const ScalarField& pressure;
    VectorField& pressure_force;

    struct Near
    {
        Lanes share; ///< V² p
    };
    struct Far
    {
        Real share;
    };
    struct Sum
    {
        VectorLanes push{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const
    {
        const Lanes v = lanes(volume, first);
        return {v * v * lanes(pressure, first)};
    }
    Far far(Index j) const { return {real(volume[j] * volume[j] * pressure[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.push -= ((i.share + j.share) * pair.gradient_over_r) * pair.offset;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        store_lanes(pressure_force, cluster.first, mobility.moving_in(cluster), sum.push);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
