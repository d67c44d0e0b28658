#pragma once

#include "models/term.hpp"

namespace cupel
{

/// The beam's power in the metal, spread over the kernel like every other surface term (Brackbill's continuum form):
///
///   P_i = Σ_j a_i P_j W_ij / S_j,   S_j = Σ_k a_k W_jk,   a = 1 for metal, 0 elsewhere      [W]
///
/// P_j is what the rays gave to the particle j that they hit. ΣP is kept to round-off. Without it the outermost layer
/// alone takes the flux q and stands q Δx/k above the next one (5000 K at 5 GW/m², 20 μm), whatever flows below it.
struct LaserShares
{
    const ScalarField& metal;
    const ScalarField& hit_power; ///< P_j, W
    ScalarField& share;           ///< P_j / S_j, W·m³

    struct Near
    {};
    struct Sum
    {
        Lanes weight{};
    };

    bool idle(const Cluster& cluster) const
    {
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
            if (hit_power[i] != 0.0) return false;
        return true;
    }
    Near near(Index) const { return {}; }
    void add(const Near&, Index j, const Pair& pair, Sum& sum) const { sum.weight += metal[j] * pair.kernel; }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            share[i] = hit_power[i] != 0.0 ? hit_power[i] / sum.weight[lane] : 0.0;
        }
    }
};

struct LaserSpreading
{
    const VectorField& position;
    const ScalarField& metal;
    const ScalarField& share;
    double axis_x, axis_y;      ///< of the beam, m
    double reach;               ///< further from the axis nothing is lit, m
    ScalarField& heating_power; ///< added to, W

    struct Near
    {};
    struct Sum
    {
        Lanes power{};
    };

    bool idle(const Cluster& cluster) const
    {
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i) {
            const Vector p = position[i];
            if ((p.x - axis_x) * (p.x - axis_x) + (p.y - axis_y) * (p.y - axis_y) < reach * reach) return false;
        }
        return true;
    }
    Near near(Index) const { return {}; }
    void add(const Near&, Index j, const Pair& pair, Sum& sum) const { sum.power += share[j] * pair.kernel; }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            heating_power[i] += metal[i] * sum.power[lane];
        }
    }
};

} // namespace cupel
