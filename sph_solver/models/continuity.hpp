#pragma once

#include "models/gradient_correction.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Continuity equation:
///
///   dρ_i/dt = ρ_i Σ_j V_j (v_i − v_j)·∇W_ij      [kg/(m³ s)]
///
/// This is the rate of Σ_j m_j W_ij: where particles crowd, density rises and pressure drives them apart. A gradient
/// corrected to be exact for linear fields would lose that tie: a shear flow has then no divergence however its
/// particles lie, and in a closed layer the packing drifts from the density (1.6 % of the depth in a quarter of a
/// turn). The price: rows that slide past each other breathe, and a stiff pressure answers with drag, which shows where
/// the sound speed is hundreds of times the flow's (validation_cases/marangoni_layer/README.md). Walls and solids take
/// part with their extrapolated velocity.
struct Continuity
{
    Mobility mobility;
    const ScalarField& density;
    const VectorField& velocity;
    ScalarField& density_rate;

    using Near = Of<Lanes, quantity::Density, quantity::Velocity>;
    using Far = Of<Real, quantity::Velocity>;
    struct Sum
    {
        Lanes divergence{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const { prefetch_all(first, mobility.weight, density, velocity, density_rate); }
    Near near(Index first) const { return {lanes(density, first), lanes(velocity, first)}; }
    Far far(Index j) const { return {real(velocity[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.divergence += pair.volume_gradient_over_r * dot(i.velocity - broadcast(j.velocity), pair.offset);
    }
    void store(const Cluster& cluster, const Near& i, const Sum& sum) const
    {
        store_lanes(density_rate, cluster.first, mobility.moving_in(cluster), i.density * sum.divergence);
    }
};

/// What of it walls and solids do by the way they move, −ρ_i Σ_w V_w v_w·∇W_iw      [kg/(m³ s)]
struct ContinuityByWalls
{
    Mobility mobility;
    const ScalarField& density;
    const VectorField& velocity;
    ScalarField& density_rate;

    using Near = Of<Lanes, quantity::Density>;
    using Far = Of<Real, quantity::Liquid, quantity::Velocity>;
    struct Sum
    {
        Lanes divergence{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const { prefetch(density_rate, first); }
    Near near(Index first) const { return {lanes(density, first)}; }
    Far far(Index j) const { return {real(mobility.weight[j]), real(velocity[j])}; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        if (j.liquid == 0) sum.divergence -= dot(broadcast(j.velocity), pair.volume_gradient);
    }
    void store(const Cluster& cluster, const Near& i, const Sum& sum) const
    {
        store_lanes(density_rate, cluster.first, mobility.moving_in(cluster), i.density * sum.divergence);
    }
};

/// Continuity in the band of a free surface whose load is carried into the liquid (surface_pressure.hpp):
///
///   dρ_i/dt = ρ_i Σ_j V_j (v_i − v_j)·L_i ∇W_ij = −ρ_i tr ∇v_i      [kg/(m³ s)]
///
/// At a free surface a kernel that is cut off sees half of what changes across the surface and most of what changes
/// along it, so that a flow without divergence seems to have one: layers move by turns too far and too little, and a
/// capillary wave of 16 spacings is 12 % slow and damped by a quarter too little (8 and 15 % with this). Elsewhere the
/// sum above is kept, the partner of the pressure force: what is lost without it is energy of the size of p' times that
/// divergence, nothing where λ bears the load, but a gravity wave then loses a fifth of its damping.
struct ContinuityOfBand
{
    Mobility mobility;
    const ScalarField& density;
    const VectorField& velocity;
    CorrectionMatrix correction;      ///< L of the last whole step
    const ScalarField* surface_delta; ///< above zero in the band; null where no load is carried: nothing to do
    ScalarField& density_rate;        ///< comes in as Continuity has it
    ScalarField* replaced;            ///< for the books: what this is more than that, kg/(m³ s)

    static constexpr bool local = true;

    template <class Scalar> struct Correction
    {
        Symmetric3<Scalar> correction;
    };
    using Near = Of<Lanes, quantity::Density, quantity::Velocity, Correction>;
    using Far = Of<Real, quantity::Velocity>;
    struct Sum
    {
        Lanes divergence{};
    };

    unsigned in_band(const Cluster& cluster) const
    {
        return surface_delta ? set_lanes(lanes(*surface_delta, cluster.first) > 0.0) & mobility.moving_in(cluster) : 0;
    }
    bool idle(const Cluster& cluster) const { return in_band(cluster) == 0; }
    void ahead(Index first) const
    {
        if (surface_delta) prefetch(*surface_delta, first);
    }
    Near near(Index first) const
    {
        const bool any = surface_delta && set_lanes(lanes(*surface_delta, first) > 0.0) != 0;
        return {lanes(density, first), lanes(velocity, first),
                any ? correction.of_cluster(first) : Symmetric3<Lanes>{}};
    }
    Far far(Index j) const { return {real(velocity[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const VectorLanes change = i.velocity - broadcast(j.velocity);
        sum.divergence += pair.volume_gradient_over_r * dot(change, i.correction * pair.offset);
    }
    void store(const Cluster& cluster, const Near& i, const Sum& sum) const
    {
        const unsigned band = in_band(cluster);
        const Lanes rate = i.density * sum.divergence;
        store_lanes(*replaced, cluster.first, band, rate - lanes(density_rate, cluster.first));
        store_lanes(density_rate, cluster.first, band, rate);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
