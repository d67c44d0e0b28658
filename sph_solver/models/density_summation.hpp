#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Volume by summation, for two phases of any density ratio (Hu & Adams 2006):
///
///   V_i = 1 / Σ_j W_ij,   ρ_i = m_i / V_i      [m³, kg/m³]
///
/// and, for the books, the rate at which a transport velocity δu alone changes it: −V_i² Σ_j (δu_i − δu_j)·∇W_ij
/// [m³/s]. Neighbours count by number, not by mass, so that the light side of an interface does not feel the heavy one.
struct DensitySummation
{
    Mobility mobility;
    const ScalarField& mass;
    const VectorField& transport; ///< δu, m/s
    ScalarField& volume;
    ScalarField& density;
    ScalarField& transport_rate;

    struct Near
    {
        VectorLanes transport;
    };
    struct Far
    {
        VectorOf<Real> transport;
    };
    struct Sum
    {
        Lanes number{}, rate{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const { return {lanes(transport, first)}; }
    Far far(Index j) const { return {real(transport[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.number += pair.kernel;
        sum.rate += pair.gradient_over_r * dot(i.transport - broadcast(j.transport), pair.offset);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0) continue;
            volume[i] = 1.0 / sum.number[lane];
            density[i] = mass[i] * sum.number[lane];
            transport_rate[i] = -volume[i] * volume[i] * sum.rate[lane];
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
