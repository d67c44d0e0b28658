#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Volume by summation, for two phases of any density ratio (Hu & Adams 2006):
///
///   V_i = 1 / Σ_j W_ij,   ρ_i = m_i / V_i      [m³, kg/m³]
///
/// Neighbours count by number, not by mass, so that the light side of an interface does not feel the heavy one.
struct DensitySummation
{
    Mobility mobility;
    const ScalarField& mass;
    ScalarField& volume;
    ScalarField& density;

    struct Near
    {};
    struct Sum
    {
        Lanes number{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index) const { return {}; }
    void add(const Near&, Index, const Pair& pair, Sum& sum) const { sum.number += pair.kernel; }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0) continue;
            volume[i] = 1.0 / sum.number[lane];
            density[i] = mass[i] * sum.number[lane];
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
