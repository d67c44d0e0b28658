#pragma once

#include <vector>

#include "models/surface_geometry.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Temperature that surface tension and recoil are evaluated at: the kernel mean over the metal around,
///
///   T̄_i = Σ_j V_j T_j W_ij / Σ_j V_j W_ij      [K]
///
/// A surface force acts on a band as wide as the kernel and its temperature is that of the band. The outermost particle
/// alone, in a gradient of a hundred kelvins a micrometre, would give the exponential recoil a temperature that belongs
/// to half a spacing of depth, and blow the film off that carries it. Both means meet as the spacing goes to zero.
struct SurfaceTemperature
{
    Mobility mobility;
    const ScalarField& volume;
    const ScalarField& temperature;
    const std::vector<Kind>& kind;
    const ScalarField& surface_delta;
    ScalarField& mean;

    struct Near
    {};
    struct Far
    {
        Real volume, volume_temperature; ///< 0 for walls
    };
    struct Sum
    {
        Lanes weight{}, temperature{};
    };

    bool idle(const Cluster& cluster) const
    {
        return none_in(cluster, [&](Index i) { return mobility.weight[i] != 0.0 && surface_delta[i] > 0.0; });
    }
    Near near(Index) const { return {}; }
    Far far(Index j) const
    {
        if (kind[static_cast<std::size_t>(j)] == Kind::wall) return {0, 0};
        return {real(volume[j]), real(volume[j] * temperature[j])};
    }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.weight += j.volume * pair.kernel;
        sum.temperature += j.volume_temperature * pair.kernel;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        store_lanes(mean, cluster.first, mobility.moving_in(cluster), sum.temperature / sum.weight);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
