#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Enthalpy that the mass exchanged by shifting (shifting.hpp) carries with it:
///
///   d(m_i h_i)/dt = Σ_j V_i V_j (ρ_j h_j δu_j + ρ_i h_i δu_i)·∇W_ij      [W]
///
/// Antisymmetric like the mass flux itself: no energy is made or lost between liquid particles.
struct EnthalpyExchange
{
    Mobility mobility;
    const ScalarField& volume;
    const ScalarField& density;
    const ScalarField& enthalpy;
    const VectorField& shift;
    const ScalarField& balance; ///< as in ShiftingExchange
    ScalarField& energy_rate;

    struct Near
    {
        Lanes volume, density, enthalpy;
        VectorLanes shift;
        Lanes balance;
    };
    struct Far
    {
        Real weight, heat, balance; ///< volume of liquid, ρ h
        VectorOf<Real> shift;
    };
    struct Sum
    {
        Lanes power{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const
    {
        return {lanes(volume, first), lanes(density, first), lanes(enthalpy, first), lanes(shift, first),
                lanes(balance, first)};
    }
    Far far(Index j) const
    {
        return {real(mobility.weight[j] * volume[j]), real(density[j] * enthalpy[j]), real(balance[j]), real(shift[j])};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes weight = i.volume * j.weight * minimum(i.balance, Lanes(j.balance)) * pair.gradient_over_r;
        sum.power += weight * (j.heat * dot(broadcast(j.shift), pair.offset) +
                               i.density * i.enthalpy * dot(i.shift, pair.offset));
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        store_if(energy_rate, cluster, sum.power, [&](Index i) { return mobility.weight[i] != 0.0; });
    }
};

} // namespace cupel::inline CUPEL_ENGINE
