#pragma once

#include <type_traits>

#include "models/velocity_gradient.hpp"

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
/// part with their extrapolated velocity; what that does to density, −ρ_i Σ_w V_w v_w·∇W_iw, is kept for the books.
///
/// At a free surface a kernel that is cut off sees half of what changes across the surface and most of what changes
/// along it, so that a flow without divergence seems to have one: layers move by turns too far and too little, and a
/// capillary wave of 16 spacings is 12 % slow and damped by a quarter too little (8 and 15 % with what follows). Where
/// the load on the surface is carried into the liquid (surface_pressure.hpp), its band takes the trace of the corrected
/// gradient, dρ/dt = −ρ tr ∇v. Elsewhere it keeps the sum, the partner of the pressure force: what is lost without it
/// is energy of the size of p' times that divergence, nothing where λ bears the load, but a gravity wave then loses a
/// fifth of its damping.
template <bool with_walls = true> struct Continuity
{
    Mobility mobility;
    const ScalarField& density;
    const VectorField& velocity;
    VelocityGradientFields gradient;  ///< ∇v, corrected, of this step
    const ScalarField* surface_delta; ///< above zero in the surface's band; null where the load is not carried
    ScalarField& density_rate;
    ScalarField& by_walls; ///< of the sum, what walls and solids do by the way they move, kg/(m³ s)
    ScalarField* replaced; ///< for the books: what the trace has more than the sum, kg/(m³ s); null where there is none

    using Near = Of<Lanes, quantity::Density, quantity::Velocity>;
    using Far =
        std::conditional_t<with_walls, Of<Real, quantity::Liquid, quantity::Velocity>, Of<Real, quantity::Velocity>>;
    struct Sum
    {
        Lanes divergence{};
        [[no_unique_address]] std::conditional_t<with_walls, Lanes, Nothing> walls{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const { prefetch_all(first, density, density_rate, by_walls); }
    Near near(Index first) const { return {lanes(density, first), lanes(velocity, first)}; }
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
        sum.divergence += change.x * pair.volume_gradient.x;
        sum.divergence += change.y * pair.volume_gradient.y;
        sum.divergence += change.z * pair.volume_gradient.z;
        if constexpr (with_walls)
            if (j.liquid == 0) sum.walls -= dot(broadcast(j.velocity), pair.volume_gradient);
    }
    void store(const Cluster& cluster, const Near& i, const Sum& sum) const
    {
        const unsigned liquid = mobility.moving_in(cluster);
        const Lanes partner = i.density * sum.divergence;
        if constexpr (with_walls)
            store_lanes(by_walls, cluster.first, liquid, i.density * sum.walls);
        else
            store_lanes(by_walls, cluster.first, liquid, Lanes{});
        if (!surface_delta) return store_lanes(density_rate, cluster.first, liquid, partner);
        const auto [u, v, w] = gradient.of_cluster(cluster.first);
        const Lanes rate = select(lanes(*surface_delta, cluster.first) > 0.0, -i.density * (u.x + v.y + w.z), partner);
        store_lanes(density_rate, cluster.first, liquid, rate);
        if (replaced) store_lanes(*replaced, cluster.first, liquid, rate - partner);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
