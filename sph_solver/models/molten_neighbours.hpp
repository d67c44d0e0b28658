#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// How much of a particle's surroundings is molten and how much still stands, counted within counting_reach:
///
///   molten_i = Σ_{j molten} 1,   standing_i = Σ_{j solid or mush} 1
///
/// A film that is one particle thick has no flow that particles could resolve: it can slide but not turn over, and is
/// swept off by the Marangoni stress. It therefore stands (and goes on heating) until the melt is two particles deep.
/// What has no solid beside it flies, however small it is.
struct MoltenNeighbours
{
    Mobility mobility;
    const ScalarField& liquid_fraction;
    const std::vector<Kind>& kind;
    double molten_above;     ///< liquid fraction from which metal flows, 1
    double smoothing_length; ///< h, m
    ScalarField& molten;
    ScalarField& standing;

    struct Near
    {};
    struct Far
    {
        Real molten, standing; ///< 1 for what it is; both 0 for a wall
    };
    struct Sum
    {
        Lanes molten{}, standing{};
    };

    bool idle(const Cluster& cluster) const
    {
        // What moves already goes on moving, whatever is around it.
        return none_in(cluster,
                       [&](Index i) { return mobility.weight[i] == 0.0 && liquid_fraction[i] >= molten_above; });
    }
    Near near(Index) const { return {}; }
    Far far(Index j) const
    {
        if (kind[static_cast<std::size_t>(j)] == Kind::wall) return {0, 0};
        return liquid_fraction[j] >= molten_above ? Far{1, 0} : Far{0, 1};
    }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes one = select(counted(pair, smoothing_length), 1.0, 0.0);
        sum.molten += j.molten * one;
        sum.standing += j.standing * one;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        store_lanes(molten, cluster.first, cluster.count, sum.molten);
        store_lanes(standing, cluster.first, cluster.count, sum.standing);
    }

    /// Share of a full neighbourhood that has to be molten before a film leaves its solid. In a film of two layers it
    /// is 22 of 33 in three dimensions, in a film of one 13.
    static constexpr double film_share = 0.6;
};

} // namespace cupel::inline CUPEL_ENGINE
