#pragma once

#include <type_traits>

#include "models/gradient_correction.hpp"
#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// What sound alone is made of, for the shorter steps that it is followed by while all else is held: continuity and
/// the force of pressure, the same sums as in continuity.hpp and momentum.hpp.
///
///   dρ_i/dt     = ρ_i Σ_j V_j (v_i − v_j)·∇W_ij                   [kg/(m³ s)]
///   m_i dv_i/dt = −Σ_j V_i V_j (p_i + p_j) ∇W_ij                  [N]
///
/// The surface's band, where its load is carried into the liquid, has the trace of the corrected gradient,
/// ρ_i Σ_j V_j (v_i − v_j)·L_i ∇W_ij, with the matrices L of the last whole step.
template <bool with_walls> struct ContinuityOfSound
{
    Mobility mobility;
    const ScalarField& density;
    const VectorField& velocity;
    CorrectionMatrix correction;
    const ScalarField* surface_delta; ///< above zero in the surface's band; null where the load is not carried
    ScalarField& density_rate;
    ScalarField& by_walls; ///< as in Continuity
    ScalarField* replaced; ///< for the books: what the trace has more than the sum, kg/(m³ s); null where there is none

    struct Near
    {
        Lanes density;
        VectorLanes velocity;
        bool in_band; ///< whether any of the cluster is
        Symmetric3<Lanes> correction;
    };
    using Far =
        std::conditional_t<with_walls, Of<Real, quantity::Liquid, quantity::Velocity>, Of<Real, quantity::Velocity>>;
    struct Sum
    {
        Lanes divergence{}, corrected{};
        [[no_unique_address]] std::conditional_t<with_walls, Lanes, Nothing> walls{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const
    {
        prefetch_all(first, mobility.weight, density, velocity, density_rate, by_walls);
        if (surface_delta) prefetch(*surface_delta, first);
        if (replaced) prefetch(*replaced, first);
    }
    Near near(Index first) const
    {
        const bool in_band = surface_delta && set_lanes(lanes(*surface_delta, first) > 0.0) != 0;
        return {lanes(density, first), lanes(velocity, first), in_band,
                in_band ? correction.of_cluster(first) : Symmetric3<Lanes>{}};
    }
    Far far(Index j) const
    {
        if constexpr (with_walls)
            return {real(mobility.weight[j]), real(velocity[j])};
        else
            return {real(velocity[j])};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const VectorLanes change = i.velocity - broadcast(j.velocity);
        sum.divergence += pair.volume_gradient_over_r * dot(change, pair.offset);
        if (i.in_band) sum.corrected += dot(change, i.correction * pair.volume_gradient);
        if constexpr (with_walls)
            if (j.liquid == 0) sum.walls -= dot(broadcast(j.velocity), pair.volume_gradient);
    }
    void store(const Cluster& cluster, const Near& i, const Sum& sum) const
    {
        const Lanes partner = i.density * sum.divergence, corrected = i.density * sum.corrected;
        const unsigned liquid = mobility.moving_in(cluster);
        if constexpr (with_walls)
            store_lanes(by_walls, cluster.first, liquid, i.density * sum.walls);
        else
            store_lanes(by_walls, cluster.first, liquid, Lanes{});
        if (!surface_delta) return store_lanes(density_rate, cluster.first, liquid, partner);
        const Lanes rate = select(lanes(*surface_delta, cluster.first) > 0.0, corrected, partner);
        store_lanes(density_rate, cluster.first, liquid, rate);
        if (replaced) store_lanes(*replaced, cluster.first, liquid, rate - partner);
    }
};

/// The second of them; what walls and solids press as in FreeSurfaceMomentum, where there are any.
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
