#pragma once

#include <algorithm>
#include <cmath>

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// b = max(0, 1 − 5 |m/m₀ − 1|): a particle that has lost or gained a fifth of its mass exchanges no more of it.
inline double exchange_balance(double mass, double lattice_mass)
{
    return std::clamp(1.0 - 5.0 * std::abs(mass / lattice_mass - 1.0), 0.0, 1.0);
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
template <bool with_enthalpy> struct ShiftingExchange
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
        Scalar speed; ///< U, m/s
    };
    template <class Scalar> struct Carried
    {
        Scalar enthalpy;
    };
    using Near =
        Of<Lanes, quantity::Density, quantity::Velocity, quantity::Shift, quantity::Mass, Speed, Exchanged, Carried>;
    using Far = Of<Real, quantity::Liquid, quantity::Density, quantity::Velocity, quantity::Shift, quantity::Mass,
                   Speed, Exchanged, Carried>;
    struct Sum
    {
        Lanes density{}, mass{}, energy{};
        VectorLanes momentum{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const
    {
        return {lanes(density, first),
                lanes(velocity, first),
                lanes(shift, first),
                lanes(mass, first),
                lanes(speed, first),
                lanes(balance, first),
                with_enthalpy ? lanes(*enthalpy, first) : Lanes{}};
    }
    Far far(Index j) const
    {
        return {real(mobility.weight[j]),
                real(density[j]),
                real(velocity[j]),
                real(shift[j]),
                real(mass[j]),
                real(speed[j]),
                real(balance[j]),
                with_enthalpy ? real((*enthalpy)[j]) : Real{}};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes balanced = minimum(i.balance, Lanes(j.balance));
        const VectorLanes weight = balanced * pair.volume_gradient;
        const Lanes other = dot(broadcast(j.shift), weight), own = dot(i.shift, weight);
        const Lanes gained = j.density * other, lost = i.density * own;
        sum.density += gained + lost - i.density * (other - own);
        const Lanes rate = Lanes(real(evening)) * (1.0 - balanced) * minimum(i.speed, Lanes(j.speed));
        const Lanes evened = (rate * (i.mass - j.mass)) * pair.volume_gradient_over_r;
        const Lanes exchanged = gained + lost + evened;
        sum.mass += j.liquid * exchanged;
        sum.momentum += (0.5 * exchanged) * (broadcast(j.velocity) - i.velocity);
        if constexpr (with_enthalpy)
            sum.energy +=
                j.liquid * (j.enthalpy * gained + i.enthalpy * lost + (0.5 * evened) * (i.enthalpy + j.enthalpy));
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0) continue;
            density_rate[i] = sum.density[lane];
            mass_rate[i] = volume[i] * sum.mass[lane];
            if constexpr (with_enthalpy) (*energy_rate)[i] = volume[i] * sum.energy[lane];
            momentum_rate.set(i, volume[i] * Vector{sum.momentum.x[lane], sum.momentum.y[lane], sum.momentum.z[lane]});
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
