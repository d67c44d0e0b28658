#pragma once

#include <algorithm>
#include <cmath>

#include "models/term.hpp"
#include "models/thermal_walls.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Heat conduction (Cleary and Monaghan 1999), as power on particle i:
///
///   P_i = Σ_j V_i V_j 4 k_i k_j/(k_i + k_j) C_i C_j (T_i − T_j) (1/r) dW/dr      [W]
///   C_i = 1/√Γ_i,   Γ_i = Σ_j V_j W_ij (and what walls of prescribed temperature fill of it)      [1]
///
/// What i gives j takes: energy is conserved to round-off. C makes up for the part of the kernel that is cut off at a
/// free or adiabatic surface, where the outermost layer of a lattice has Γ = 0.77 and would conduct that much too
/// little along the surface; and for the noise of a disordered neighbourhood. Inside a lattice it is 1. Beside the
/// formula without it (moving source 20 μm, Stefan with jitter): error of T 0.3 against 0.7 %, of the front 0.4
/// against 3.1 %. A particle of conductivity 0 (walls) takes no part; walls of prescribed temperature:
/// thermal_walls.hpp.
struct HeatConduction
{
    const ScalarField& volume;       ///< V, m³
    const ScalarField& temperature;  ///< T, K
    const ScalarField& conductivity; ///< k, W/(m·K)
    const ScalarField& correction;   ///< C, 1
    ScalarField& power;              ///< P, W: set, not added to

    struct Near
    {
        Lanes volume, temperature, conductivity, correction;
    };
    struct Far
    {
        Real temperature, conductivity, weight; ///< weight: 4 k_j V_j C_j; 0 for walls, of which nothing is stored
    };
    struct Sum
    {
        Lanes power{};
    };

    bool idle(const Cluster& cluster) const
    {
        return none_in(cluster, [&](Index i) { return conductivity[i] > 0.0; });
    }
    Near near(Index first) const
    {
        return {lanes(volume, first), lanes(temperature, first), lanes(conductivity, first), lanes(correction, first)};
    }
    Far far(Index j) const
    {
        return {real(temperature[j]), real(conductivity[j]), real(4.0 * conductivity[j] * volume[j] * correction[j])};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        // Between walls it is no number, and not stored.
        const Lanes mean = j.weight * i.conductivity * reciprocal(i.conductivity + j.conductivity);
        sum.power += mean * (i.temperature - j.temperature) * pair.gradient_over_r;
    }
    void store(const Cluster& cluster, const Near& i, const Sum& sum) const
    {
        store_if(power, cluster, i.volume * i.correction * sum.power, [&](Index k) { return conductivity[k] > 0.0; });
    }
};

/// C_i = 1/√Γ_i, Γ_i = Σ_j V_j W_ij over particles that conduct, and over walls of prescribed temperature      [1]
///
/// Γ counts as 0.2 at least, just above the share of a particle alone in space (0.175 in three dimensions).
struct KernelCompleteness
{
    static constexpr double smallest = 0.2;

    const ScalarField& volume;
    const ScalarField& conductivity;
    const VectorField& position;
    const ThermalWalls& walls;
    ScalarField& correction; ///< C

    struct Near
    {};
    struct Far
    {
        Real conducting_volume;
    };
    struct Sum
    {
        Lanes share{};
    };

    bool idle(const Cluster&) const { return false; }
    Near near(Index) const { return {}; }
    Far far(Index j) const { return {real(conductivity[j] > 0.0 ? volume[j] : 0.0)}; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.share += j.conducting_volume * pair.kernel;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            const double share = sum.share[lane] + walls.filling(position[i]).conducting_share;
            correction[i] = 1.0 / std::sqrt(std::max(smallest, share));
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
