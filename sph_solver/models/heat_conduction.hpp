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
/// What i gives j takes: energy is conserved to round-off. C (KernelCompleteness) makes up for the part of the kernel
/// that is cut off at a free or adiabatic surface, where the outermost layer of a lattice has 0.78 of the neighbours
/// along the surface and would conduct that much too little; and for the noise of a disordered neighbourhood. Inside a
/// lattice it is 1. A particle of conductivity 0 (walls) takes no part; walls of prescribed temperature:
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
        store_lanes(power, cluster.first, lanes_where(cluster, [&](Index k) { return conductivity[k] > 0.0; }),
                    i.volume * i.correction * sum.power);
    }
};

/// What a particle's neighbourhood lacks of a whole and even one:
///
///   C_i = (Γ_i/M_i)^(0.7 (1 − s)) / √Γ_i                                                                       [1]
///   Γ_i = Σ_j V_j W_ij,   B_i = −Σ_j V_j (1/r dW/dr) r_ij ⊗ r_ij,   M_i = (tr B_i − n·B_i n)/(d − 1)           [1]
///
/// over particles that conduct, and over walls of prescribed temperature, which count as filled. B is the identity
/// where the kernel is whole; n is the direction of N_i = Σ_j V_j ∇W_ij, out of the liquid at a surface, so that M is
/// the moment along the surface. In a lattice, in the layers below its surface as well, Γ and M are the same and C is
/// 1/√Γ. In disorder the sum conducts too little, half because M falls, half because heat goes round what conducts
/// badly, while Γ, which counts the particle itself, rises: the ratio of the two tells disorder from a surface. In the
/// outermost layer, where N wavers, s ends that (h|N| from 0.3 to 0.45; 0.46 there). The exponent is fitted on
/// particles displaced at random (h = Δx); conductivity of such a body, and in brackets of a slab's two surfaces, in
/// two / three dimensions,
///
///   displaced by up to    1/√Γ              this
///   0.1 Δx                −0.9 / −0.5 %     0.0 / 0.0 %  (+0.07 / +0.03 Δx)
///   0.2 Δx                −3.5 / −2.1 %     0.0 / +0.2 %  (+0.04 / 0.00 Δx)
///   0.3 Δx                −7.5 / −4.4 %     −0.2 / +0.6 %  (−0.01 / −0.04 Δx)
///
/// Γ and M count as 0.2 at least, just above the share of a particle alone in space (0.171 in three dimensions).
struct KernelCompleteness
{
    static constexpr double smallest = 0.2;

    int dimensions;
    double smoothing_length; ///< h, m
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
        VectorLanes away{};                       ///< Σ V ∇W
        Lanes xx{}, yy{}, zz{}, xy{}, xz{}, yz{}; ///< −B
    };

    bool idle(const Cluster&) const { return false; }
    Near near(Index) const { return {}; }
    Far far(Index j) const { return {real(conductivity[j] > 0.0 ? volume[j] : 0.0)}; }
    bool ignores(const Far& j) const { return j.conducting_volume == 0; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.share += j.conducting_volume * pair.kernel;
        const VectorLanes gradient = (j.conducting_volume * pair.gradient_over_r) * pair.offset;
        sum.away += gradient;
        sum.xx += gradient.x * pair.offset.x;
        sum.yy += gradient.y * pair.offset.y;
        sum.zz += gradient.z * pair.offset.z;
        sum.xy += gradient.x * pair.offset.y;
        sum.xz += gradient.x * pair.offset.z;
        sum.yz += gradient.y * pair.offset.z;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            const ThermalWalls::Filling filling = walls.filling(position[i]);
            const double share = std::max(smallest, sum.share[lane] + filling.conducting_share);
            const Vector n = Vector{sum.away.x[lane], sum.away.y[lane], sum.away.z[lane]} + filling.conducting_gradient;
            const double moment = std::max(smallest, moment_across(n, sum, lane, filling.conducting_moment));
            const double inside = std::clamp((0.45 - smoothing_length * norm(n)) / 0.15, 0.0, 1.0);
            correction[i] = std::pow(share / moment, 0.7 * inside) / std::sqrt(share);
        }
    }

private:
    /// Of the kernel in the plane across n, 1.
    double moment_across(const Vector& n, const Sum& sum, int lane, const Vector& filled) const
    {
        const Vector diagonal = filled - Vector{sum.xx[lane], sum.yy[lane], sum.zz[lane]};
        const double trace = diagonal.x + (dimensions == 2 ? 0.0 : diagonal.y) + diagonal.z, square = dot(n, n);
        if (square == 0.0) return trace / dimensions;
        const double along = n.x * n.x * diagonal.x + n.y * n.y * diagonal.y + n.z * n.z * diagonal.z -
                             2.0 * (n.x * n.y * sum.xy[lane] + n.x * n.z * sum.xz[lane] + n.y * n.z * sum.yz[lane]);
        return (trace - along / square) / (dimensions - 1);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
