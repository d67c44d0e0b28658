#pragma once

#include <vector>

#include "kernels/neighbour_list.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The neighbour list of a scene and which of its clusters have work: those with liquid that moves, and those with
/// walls or solids that such liquid touches. Everything else costs the flow nothing.
class Neighbourhood
{
public:
    Neighbourhood(double support, double skin, double spacing, int dimensions);

    /// Lists anew where a particle has moved too far: what moves and what it is near, or, where that is much,
    /// everything.
    void update(Particles& particles, const ScalarField& mobility);
    void rebuild(Particles& particles, const ScalarField& mobility);
    /// After particles melted or solidified: which clusters have work.
    void classify(const Particles& particles, const ScalarField& mobility);

    const NeighbourList& list() const { return list_; }
    const std::vector<Index>& all() const { return all_; }
    const std::vector<Index>& moving() const { return moving_; }
    const std::vector<Index>& standing() const { return standing_; }
    /// Places of the particles that move, in order.
    const std::vector<Index>& moving_particles() const { return moving_particles_; }

private:
    void forget_wanderers();

    NeighbourList list_;
    std::vector<Index> all_, moving_, standing_, moving_particles_;
    std::vector<Index> wandered_; ///< clusters in which something has moved since it was listed
    std::vector<unsigned char> has_wandered_;
};

} // namespace cupel::inline CUPEL_ENGINE
