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
    const ScalarField& temperature;
    const std::vector<Kind>& kind;
    const ScalarField& surface_delta;
    ScalarField& mean;

    static constexpr bool local = true;

    template <class Scalar> struct Metal
    {
        Scalar metal; ///< 1, 0 for walls
    };
    struct Near
    {};
    using Far = Of<Real, quantity::Temperature, Metal>;
    struct Sum
    {
        Lanes weight{}, temperature{};
    };

    bool idle(const Cluster& cluster) const
    {
        return (set_lanes(lanes(surface_delta, cluster.first) > 0.0) & mobility.moving_in(cluster)) == 0;
    }
    Near near(Index) const { return {}; }
    Far far(Index j) const
    {
        return {real(temperature[j]), kind[static_cast<std::size_t>(j)] == Kind::wall ? Real(0) : Real(1)};
    }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes weight = j.metal * pair.volume_kernel;
        sum.weight += weight;
        sum.temperature += j.temperature * weight;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        store_lanes(mean, cluster.first, mobility.moving_in(cluster), sum.temperature / sum.weight);
    }
};

/// Gradient of temperature near a surface, corrected as ScalarGradient's is (gradient_correction.hpp)      [K/m]
struct SurfaceTemperatureGradient
{
    Mobility mobility;
    const ScalarField& temperature;
    const ScalarField& wanted; ///< above zero where it is asked for
    VectorField& raw_gradient; ///< to be multiplied by L_i there

    static constexpr bool local = true;

    using Near = Of<Lanes, quantity::Temperature>;
    using Far = Of<Real, quantity::Temperature>;
    struct Sum
    {
        VectorLanes gradient{};
    };

    bool idle(const Cluster& cluster) const
    {
        return (set_lanes(lanes(wanted, cluster.first) > 0.0) & mobility.moving_in(cluster)) == 0;
    }
    Near near(Index first) const { return {lanes(temperature, first)}; }
    Far far(Index j) const { return {real(temperature[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.gradient += (j.temperature - i.temperature) * pair.volume_gradient;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        store_lanes(raw_gradient, cluster.first, mobility.moving_in(cluster), sum.gradient);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
