#pragma once

#include "models/term.hpp"

namespace cupel
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
    struct Sum
    {
        Lanes power{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const
    {
        return {volume.lanes(first), density.lanes(first), enthalpy.lanes(first), shift.lanes(first),
                balance.lanes(first)};
    }
    void add(const Near& i, Index j, const Pair& pair, Sum& sum) const
    {
        if (mobility.weight[j] == 0.0) return;
        const Lanes weight = i.volume * volume[j] * minimum(i.balance, all_lanes(balance[j])) * pair.gradient_over_r;
        sum.power += weight * ((density[j] * enthalpy[j]) * dot(broadcast(shift[j]), pair.offset) +
                               i.density * i.enthalpy * dot(i.shift, pair.offset));
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        store_if(energy_rate, cluster, sum.power, [&](Index i) { return mobility.weight[i] != 0.0; });
    }
};

} // namespace cupel
