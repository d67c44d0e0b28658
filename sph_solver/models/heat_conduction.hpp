#pragma once

#include <algorithm>

#include "models/term.hpp"
#include "models/thermal_walls.hpp"

namespace cupel
{

/// Heat conduction (Cleary and Monaghan 1999), as power on particle i:
///
///   P_i = Σ_j V_i V_j 4 k_i k_j/(k_i + k_j) C_ij (T_i − T_j) (1/r) dW/dr      [W]
///   C_ij = 2/(Γ_i + Γ_j),   Γ_i = Σ_j V_j W_ij (and what walls of prescribed temperature fill of it)      [1]
///
/// What i gives j takes: energy is conserved to round-off. C_ij makes up for the part of the kernel that is cut off at
/// a free or adiabatic surface (0.22 of it in the outermost layer of a lattice); inside it is 1. Without it the
/// outermost layer conducts too little along the surface.
/// A particle of conductivity 0 (walls) takes no part; walls of prescribed temperature: thermal_walls.hpp.
struct HeatConduction
{
    const ScalarField& volume;          ///< V, m³
    const ScalarField& temperature;     ///< T, K
    const ScalarField& conductivity;    ///< k, W/(m·K)
    const ScalarField& completeness;    ///< Γ, 1
    ScalarField& power;                 ///< P, W: set, not added to

    struct Near
    {
        Lanes volume, temperature, conductivity, completeness;
    };
    struct Sum
    {
        Lanes power{};
    };

    bool idle(const Cluster& cluster) const
    {
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
            if (conductivity[i] > 0.0)
                return false;
        return true;
    }
    Near near(Index first) const
    {
        return {volume.lanes(first), temperature.lanes(first), conductivity.lanes(first), completeness.lanes(first)};
    }
    void add(const Near& i, Index j, const Pair& pair, Sum& sum) const
    {
        const double k_j = conductivity[j];
        if (!(k_j > 0.0))
            return;
        const Lanes mean = (8.0 * k_j * volume[j]) * i.conductivity /
                           ((i.conductivity + k_j) * (i.completeness + completeness[j]));
        sum.power += mean * (i.temperature - temperature[j]) * pair.gradient_over_r;
    }
    void store(const Cluster& cluster, const Near& i, const Sum& sum) const
    {
        store_if(power, cluster, i.volume * sum.power, [&](Index k) { return conductivity[k] > 0.0; });
    }
};

/// Γ_i = Σ_j V_j W_ij over particles that conduct, and over walls of prescribed temperature      [1]
///
/// At least 0.2, which the self-contribution of a particle alone in space falls just short of in three dimensions.
struct KernelCompleteness
{
    static constexpr double smallest = 0.2;

    const ScalarField& volume;
    const ScalarField& conductivity;
    const VectorField& position;
    const ThermalWalls& walls;
    ScalarField& completeness;

    struct Near
    {
    };
    struct Sum
    {
        Lanes share{};
    };

    bool idle(const Cluster&) const { return false; }
    Near near(Index) const { return {}; }
    void add(const Near&, Index j, const Pair& pair, Sum& sum) const
    {
        if (conductivity[j] > 0.0)
            sum.share += volume[j] * pair.kernel;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane)
        {
            const Index i = cluster.first + lane;
            completeness[i] = std::max(smallest, sum.share[lane] + walls.filling(position[i]).conducting_share);
        }
    }
};

}  // namespace cupel
