#pragma once

#include "models/term.hpp"
#include "models/thermal_walls.hpp"

namespace cupel
{

/// Where metal faces the surrounding: the gradient of its share of space, summed over all metal, solid or liquid,
///
///   G_i = Σ_j V_j ∇W_ij      [1/m];      δ = 2|G|,   exposed area = V δ [m²],   outward normal n̂ = −G/|G|
///
/// Walls count as full of metal: it is not exposed where it touches one. Across a flat surface ΣVδ is its area, 0.9 of
/// it in the outermost layer of a lattice. Kept is the strength |G| h [1].
struct MetalGradient
{
    const ScalarField& volume;
    const ScalarField& metal;       ///< 1 for the primary material, 0 for a surrounding with particles and for walls
    const VectorField& position;
    const ThermalWalls& walls;
    double smoothing_length;        ///< h, m
    ScalarField& strength;          ///< |G| h; 0 where there is no metal

    struct Near
    {
    };
    struct Sum
    {
        VectorLanes gradient{};
    };

    bool idle(const Cluster&) const { return false; }
    Near near(Index) const { return {}; }
    void add(const Near&, Index j, const Pair& pair, Sum& sum) const
    {
        const double weight = metal[j] * volume[j];
        sum.gradient += (weight * pair.gradient_over_r) * pair.offset;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane)
        {
            const Index i = cluster.first + lane;
            const Vector particles{sum.gradient.x[lane], sum.gradient.y[lane], sum.gradient.z[lane]};
            strength[i] = metal[i] * norm(particles + walls.filling(position[i]).gradient) * smoothing_length;
        }
    }
};

/// Which particles are exposed: those with |G| h > 0.25 (the surface itself), and their neighbours, which carry the rest
/// of δ. The noise of G elsewhere inside is no surface, and a single grain particle, which has G = 0, neither radiates
/// nor evaporates; a few of them expose at most 2|G|V each, which is bounded by the kernel.
struct ExposedArea
{
    static constexpr double surface_threshold = 0.25;
    static constexpr double negligible = 0.02;

    const ScalarField& volume;
    const ScalarField& strength;
    double smoothing_length;    ///< h, m
    ScalarField& area;          ///< V δ, m²; 0 inside

    struct Near
    {
    };
    struct Sum
    {
        Lanes surface{};
    };

    bool idle(const Cluster&) const { return false; }
    Near near(Index) const { return {}; }
    void add(const Near&, Index j, const Pair& pair, Sum& sum) const
    {
        if (strength[j] > surface_threshold)
            sum.surface += pair.kernel;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane)
        {
            const Index i = cluster.first + lane;
            const bool exposed = strength[i] > negligible && sum.surface[lane] > 0.0;
            area[i] = exposed ? 2.0 * volume[i] * strength[i] / smoothing_length : 0.0;
        }
    }
};

}  // namespace cupel
