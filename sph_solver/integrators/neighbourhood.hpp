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

    /// Rebuilds the list where a particle has moved too far. Returns whether it did.
    bool update(Particles& particles, const ScalarField& mobility);
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
    NeighbourList list_;
    std::vector<Index> all_, moving_, standing_, moving_particles_;
};

} // namespace cupel::inline CUPEL_ENGINE
