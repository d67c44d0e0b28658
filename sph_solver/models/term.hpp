#pragma once

#include "kernels/pair_loop.hpp"
#include "particles/particles.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Where neighbours are counted: within 2.12 smoothing lengths. A lattice (h = Δx) has neighbours at 2 and at √5
/// spacings; a limit in between counts the same 33 (13 in two dimensions) whatever round-off does to their distance.
inline constexpr double counting_reach = 2.12;
inline LaneMask counted(const Pair& pair, double smoothing_length)
{
    return pair.square < counting_reach * counting_reach * smoothing_length * smoothing_length;
}
/// What is counted so in a full lattice, the particle itself included.
constexpr double lattice_companions(int dimensions)
{
    return dimensions == 2 ? 13.0 : 33.0;
}

/// Whether no particle of a cluster is one for which concerned(i) holds.
template <class Concerned> bool none_in(const Cluster& cluster, const Concerned& concerned)
{
    for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
        if (concerned(i)) return false;
    return true;
}

/// 1 for a particle whose momentum is integrated, 0 for one that stands: the weight by which sums over "the liquid"
/// leave out walls and solids.
struct Mobility
{
    const ScalarField& weight;

    /// Which particles of a cluster move, a bit for each.
    unsigned moving_in(const Cluster& cluster) const
    {
        return set_lanes(lanes(weight, cluster.first) > 0.0) & cluster.lanes();
    }
    bool none_in(const Cluster& cluster) const { return moving_in(cluster) == 0; }
    bool all_in(const Cluster& cluster) const { return moving_in(cluster) == cluster.lanes(); }
};

/// Of a cluster those for which choose(i) holds, a bit for each.
template <class Choose> unsigned lanes_where(const Cluster& cluster, const Choose& choose)
{
    unsigned lanes = 0;
    for (Index lane = 0; lane < cluster.count; ++lane)
        lanes |= static_cast<unsigned>(choose(cluster.first + lane)) << lane;
    return lanes;
}

} // namespace cupel::inline CUPEL_ENGINE
