#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/term.hpp"
#include "models/thermal_walls.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Where metal faces the surrounding: the gradient of its share of space, summed over all metal, solid or liquid,
///
///   G_i = Σ_j V_j ∇W_ij      [1/m];      δ = 2|G|/λ where |G| h > 0.2, else 0;      exposed area = V δ      [m²]
///
/// (outward normal −G/|G|). Walls count as full of metal: it is not exposed where it touches one. The threshold takes
/// the outermost layer alone and leaves the noise of G inside out; λ is the part of the full δ that this layer has on a
/// lattice (outermost_layer_share), so that across a flat surface ΣVδ is its area. Measured with a jitter of 0 and 20
/// %: plate 1.00, ball of radius 8 Δx 0.92, 4 Δx 0.87, 2 Δx 0.66.
///
/// A grain of one or two particles has no slope to speak of, G → 0, and yet is all surface. Where the neighbourhood is
/// less than half full, Γ_i = Σ_j V_j W_ij < ½ (a cube's corner has 0.4), the area of a sphere of the particle's volume
/// takes over by degrees:   area ≥ (36π)^⅓ V^⅔ (1 − 2Γ).   Without it spatter that the beam heats could not cool.
struct ExposedSurface
{
    static constexpr double threshold = 0.2;

    const ScalarField& volume;
    const ScalarField& metal; ///< 1 for the primary material, 0 for a surrounding with particles and for walls
    const VectorField& position;
    const ThermalWalls& walls;
    double smoothing_length;      ///< h, m
    double outermost_layer_share; ///< λ, 1
    ScalarField& area;            ///< exposed area, m²

    struct Near
    {};
    struct Far
    {
        Real metal_volume;
    };
    struct Sum
    {
        VectorLanes gradient{};
        Lanes filling{};
    };

    bool idle(const Cluster&) const { return false; }
    Near near(Index) const { return {}; }
    Far far(Index j) const { return {real(metal[j] * volume[j])}; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.gradient += (j.metal_volume * pair.gradient_over_r) * pair.offset;
        sum.filling += j.metal_volume * pair.kernel;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            const Vector particles{sum.gradient.x[lane], sum.gradient.y[lane], sum.gradient.z[lane]};
            const auto wall = walls.filling(position[i]);
            const double slope = metal[i] * norm(particles + wall.gradient);
            const double flat =
                slope * smoothing_length > threshold ? volume[i] * 2.0 * slope / outermost_layer_share : 0.0;
            const double emptiness = std::max(0.0, 1.0 - 2.0 * (sum.filling[lane] + wall.share));
            area[i] = flat;
            if (emptiness > 0.0)
                area[i] =
                    std::max(flat, metal[i] * emptiness * std::cbrt(36.0 * std::numbers::pi * volume[i] * volume[i]));
        }
    }
};

/// λ: twice |G| Δx in the outermost layer of a lattice that fills a half space, i.e. of layers at Δx, 2 Δx … below.
inline double outermost_layer_share(const WallLayers& layers, double spacing)
{
    return 2.0 * layers.slope(0.5 * spacing) * spacing;
}

} // namespace cupel::inline CUPEL_ENGINE
