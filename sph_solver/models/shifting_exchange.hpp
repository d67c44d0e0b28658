#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// b = max(0, 1 − 5 |m/m₀ − 1|): a particle that has lost or gained a fifth of its mass exchanges no more of it.
template <class Scalar> Scalar exchange_balance(const Scalar& mass, double lattice_mass)
{
    const Scalar one(1.0), excess = Scalar(1.0 / lattice_mass) * mass - one;
    return clamp(one - Scalar(5.0) * select(excess > Scalar(0.0), excess, -excess), 0.0, 1.0);
}

/// What a particle that moves with v + δu exchanges with its neighbours (arbitrary Lagrangian-Eulerian form, after
/// Sun, Colagrossi, Marrone, Zhang 2019 and Antuono et al. 2021). With u_ij = V_j δu_j·∇W_ij and w_ij = V_j δu_i·∇W_ij:
///
///   dm_i/dt      = V_i Σ_j (ρ_j u_ij + ρ_i w_ij)                           [kg/s]
///   dρ_i/dt      = Σ_j [ρ_j u_ij + ρ_i w_ij − ρ_i (u_ij − w_ij)]           [kg/(m³ s)]
///   m_i dv_i/dt  = V_i Σ_j ρ_j u_ij (v_j − v_i)                            [N]
///   d(m_i h_i)/dt = V_i Σ_j (h_j ρ_j u_ij + h_i ρ_i w_ij)                  [W]
///
/// Each pair's exchange is multiplied by min(b_i, b_j) (exchange_balance): no particle gains or loses more than a fifth
/// of its mass. What i gains j loses: mass and energy are conserved to round-off between liquid particles; walls and
/// solids exchange none.
template <bool with_enthalpy, bool with_walls = true> struct ShiftingExchange
{
    Mobility mobility;
    const ScalarField& volume;
    const ScalarField& density;
    const VectorField& velocity;
    const VectorField& shift;
    const ScalarField& mass;
    const ScalarField& speed;    ///< U inside the liquid, elsewhere zero, m/s
    double evening;              ///< h/2V₀, 1/m² (1/m between flat particles)
    const ScalarField& balance;  ///< b, 1: falls to 0 as a particle's mass leaves its bounds
    const ScalarField* enthalpy; ///< h, J/kg; only asked where the exchange carries it
    ScalarField& density_rate;   ///< kg/(m³ s)
    ScalarField& mass_rate;      ///< kg/s
    VectorField& momentum_rate;  ///< N
    ScalarField* energy_rate;    ///< W

    template <class Scalar> struct Exchanged
    {
        Scalar balance;
    };
    template <class Scalar> struct Speed
    {
        Scalar half_evening_speed; ///< h/4V₀ U
    };
    template <class Scalar> struct DensityShift
    {
        VectorOf<Scalar> density_shift; ///< ρ δu
    };
    template <class Scalar> struct Carried
    {
        Scalar enthalpy;
    };
    using Near =
        Of<Lanes, quantity::Density, quantity::Velocity, DensityShift, quantity::Mass, Speed, Exchanged, Carried>;
    using OfLiquid =
        Of<Real, quantity::Density, quantity::Velocity, quantity::Shift, quantity::Mass, Speed, Exchanged, Carried>;
    using OfAny = Of<Real, quantity::Density, quantity::Velocity, quantity::Shift, quantity::Mass, Speed, Exchanged,
                     Carried, quantity::Liquid>;
    using Far = std::conditional_t<with_walls, OfAny, OfLiquid>;
    struct Sum
    {
        Lanes density{}, mass{};
        Lanes energy{}, with_own{}; ///< what comes with h_j, W/m³; mass that goes with h_i, kg/(m³ s)
        VectorLanes momentum{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const
    {
        prefetch_all(first, volume, shift, mass, speed, balance, density_rate, mass_rate, momentum_rate);
        if constexpr (with_enthalpy) prefetch_all(first, *enthalpy, *energy_rate);
    }
    Near near(Index first) const
    {
        const Lanes density_i = lanes(density, first);
        return {density_i,
                lanes(velocity, first),
                density_i * lanes(shift, first),
                lanes(mass, first),
                Lanes(real(0.5 * evening)) * lanes(speed, first),
                lanes(balance, first),
                with_enthalpy ? lanes(*enthalpy, first) : Lanes{}};
    }
    Far far(Index j) const
    {
        const OfLiquid far{real(density[j]),
                           real(velocity[j]),
                           real(shift[j]),
                           real(mass[j]),
                           real(0.5 * evening * speed[j]),
                           real(balance[j]),
                           with_enthalpy ? real((*enthalpy)[j]) : Real{}};
        if constexpr (with_walls)
            return {far.density,
                    far.velocity,
                    far.shift,
                    far.mass,
                    far.half_evening_speed,
                    far.balance,
                    far.enthalpy,
                    real(mobility.weight[j])};
        else
            return far;
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes balanced = minimum(i.balance, Lanes(j.balance));
        const Lanes weight = balanced * pair.volume_gradient_over_r;
        const Lanes other = weight * dot(broadcast(j.shift), pair.offset);
        const Lanes gained = j.density * other, lost = weight * dot(i.density_shift, pair.offset);
        sum.density += (j.density - i.density) * other;
        sum.density += 2.0 * lost;
        // Half of what evens masses is taken with h_j, half with h_i.
        const Lanes rate = (1.0 - balanced) * minimum(i.half_evening_speed, Lanes(j.half_evening_speed));
        const Lanes half_evened = (rate * pair.volume_gradient_over_r) * (i.mass - j.mass);
        const Lanes with_j = gained + half_evened, with_i = lost + half_evened, exchanged = with_j + with_i;
        sum.momentum += exchanged * (broadcast(j.velocity) - i.velocity);
        const auto if_liquid = [&](const Lanes& amount) {
            if constexpr (with_walls)
                return j.liquid * amount;
            else
                return amount;
        };
        sum.mass += if_liquid(exchanged);
        if constexpr (with_enthalpy) {
            sum.with_own += if_liquid(with_i);
            sum.energy += if_liquid(j.enthalpy * with_j);
        }
    }
    void store(const Cluster& cluster, const Near& i, const Sum& sum) const
    {
        const unsigned liquid = mobility.moving_in(cluster);
        const Lanes v = lanes(volume, cluster.first);
        store_lanes(density_rate, cluster.first, liquid, sum.density);
        store_lanes(mass_rate, cluster.first, liquid, v * sum.mass);
        if constexpr (with_enthalpy)
            store_lanes(*energy_rate, cluster.first, liquid, v * (sum.energy + i.enthalpy * sum.with_own));
        store_lanes(momentum_rate, cluster.first, liquid, (0.5 * v) * sum.momentum);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
