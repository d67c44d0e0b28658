#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/neighbour_list.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The neighbour list of a scene and which of its clusters have work: those with liquid that moves, and those with
/// walls or solids that such liquid touches. Everything else costs the flow nothing.
class Neighbourhood
{
public:
    Neighbourhood(double support, double skin, double spacing, int dimensions, Images images = {});

    /// Without this saving, to measure what it is worth: momentum where nothing moves, or lists anew everywhere.
    void compute_everywhere();
    void list_everywhere() { lists_everywhere_ = true; }

    /// Lists anew where a particle has moved too far: what moves and what it is near, or, where that is much,
    /// everything.
    void update(Particles& particles, const ScalarField& mobility);
    void rebuild(Particles& particles, const ScalarField& mobility);
    /// After particles melted or solidified: which clusters have work.
    void classify(const Particles& particles, const ScalarField& mobility);

    const NeighbourList& list() const { return list_; }
    /// Counts how often lists, or what moves, have changed.
    std::uint64_t version() const { return version_; }
    const std::vector<Index>& all() const { return all_; }
    const std::vector<Index>& moving() const { return moving_; }
    const std::vector<Index>& standing() const { return standing_; }
    /// Both, in order.
    const std::vector<Index>& working() const { return working_; }
    /// Whether something that stands is within the kernel's support of a particle that moves. Clusters may hold both,
    /// so that standing() need not be empty where nothing is met.
    bool meets_what_stands(const Particles& particles, const ScalarField& mobility) const;
    /// Places of the particles that move, in order.
    const std::vector<Index>& moving_particles() const { return moving_particles_; }

    /// Those of the clusters with moving particles that are neighbours of the clusters given, themselves included.
    std::vector<Index> moving_near(std::span<const Index> clusters) const;

    /// apply(place) for each particle that moves; by all threads where there are enough particles to share.
    template <class Apply> void for_each_moving(const Apply& apply) const
    {
        const std::size_t count = moving_particles_.size();
#pragma omp parallel for schedule(static) if (count > 1024)
        for (std::size_t m = 0; m < count; ++m)
            apply(moving_particles_[m]);
    }

private:
    void forget_wanderers();

    NeighbourList list_;
    std::vector<Index> all_, moving_, standing_, working_, moving_particles_;
    std::vector<Index> wandered_; ///< clusters in which something has moved since it was listed
    std::vector<unsigned char> has_wandered_;
    std::uint64_t version_ = 0;
    bool computes_everywhere_ = false, lists_everywhere_ = false;
};

} // namespace cupel::inline CUPEL_ENGINE
