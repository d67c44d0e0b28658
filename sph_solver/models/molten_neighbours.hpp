#pragma once

#include "models/term.hpp"

namespace cupel
{

/// How much of a particle's surroundings is molten and how much still stands, counted within two smoothing lengths:
///
///   molten_i = Σ_{j molten} 1,   standing_i = Σ_{j solid or mush} 1
///
/// A film that is one particle thick has no flow that particles could resolve: alone on its solid each of its particles
/// would be thrown off by the first pressure wave. It therefore stands (and goes on heating) until the melt is some
/// particles deep. What has no solid beside it flies, however small it is.
struct MoltenNeighbours
{
    const ScalarField& liquid_fraction;
    const std::vector<Kind>& kind;
    double molten_above;     ///< liquid fraction from which metal flows, 1
    double smoothing_length; ///< h, m
    ScalarField& molten;
    ScalarField& standing;

    struct Near
    {};
    struct Sum
    {
        Lanes molten{}, standing{};
    };

    bool idle(const Cluster& cluster) const
    {
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
            if (liquid_fraction[i] >= molten_above) return false;
        return true;
    }
    Near near(Index) const { return {}; }
    void add(const Near&, Index j, const Pair& pair, Sum& sum) const
    {
        if (kind[static_cast<std::size_t>(j)] == Kind::wall) return;
        const Lanes one = pair.distance < 2.0 * smoothing_length ? all_lanes(1.0) : Lanes{};
        (liquid_fraction[j] >= molten_above ? sum.molten : sum.standing) += one;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        molten.store(cluster.first, cluster.count, sum.molten);
        standing.store(cluster.first, cluster.count, sum.standing);
    }

    /// Share of a full neighbourhood that has to be molten before a film leaves its solid: four of 33 in three
    /// dimensions.
    static constexpr double film_share = 0.25;
};

} // namespace cupel
