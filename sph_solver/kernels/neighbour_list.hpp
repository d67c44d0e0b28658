#pragma once

#include <span>
#include <vector>

#include "math/lanes.hpp"
#include "particles/particles.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Consecutive particles (at most lane_count) that share one list of neighbours.
struct Cluster
{
    Index first;
    Index count;
};

/// Orders particles in vertical columns and keeps, for each cluster, the particles within
/// support + skin of any of them. A list stays valid while no particle has moved further than skin/2 since it was
/// built: two particles that were further apart than support + skin then are still further apart than the support.
class NeighbourList
{
public:
    /// support and skin in m; dimensions 2 or 3; spacing is the particle spacing that sets the width of a column.
    NeighbourList(double support, double skin, double spacing, int dimensions);

    /// Sorts all particles into columns, cuts clusters and lists their neighbours.
    void build(Particles& particles);

    /// Whether one of the particles that move (places) has moved further than half the skin since the last build.
    bool outdated(const Particles& particles, std::span<const Index> moving) const;

    Index cluster_count() const { return static_cast<Index>(clusters_.size()); }
    const Cluster& cluster(Index c) const { return clusters_[static_cast<std::size_t>(c)]; }
    std::span<const Index> neighbours(Index c) const
    {
        const auto& range = ranges_[static_cast<std::size_t>(c)];
        return {chunks_[static_cast<std::size_t>(range.chunk)].data() + range.begin,
                static_cast<std::size_t>(range.count)};
    }
    std::uint64_t builds() const { return builds_; }
    double support() const { return support_; }
    /// Corners of the box that the particles spanned when the list was built, m.
    const Vector& lower() const { return lower_; }
    const Vector& upper() const { return upper_; }
    std::size_t bytes() const;

private:
    struct Range
    {
        Index chunk;
        std::size_t begin;
        Index count;
    };
    struct Box
    {
        Vector lower, upper;
    };

    void sort_into_columns(Particles& particles);
    void find_neighbours(const Particles& particles);
    void list_cluster(const Particles& particles, Index c, std::vector<Index>& candidates,
                      std::vector<Index>& found) const;
    Index column_x(double x) const;
    Index column_y(double y) const;

    double support_, skin_, column_width_;
    Vector lower_{}, upper_{};
    Index columns_x_ = 0, columns_y_ = 0;
    std::vector<Index> first_cluster_of_column_;
    std::vector<Cluster> clusters_;
    std::vector<Box> boxes_;
    std::vector<Range> ranges_;
    std::vector<std::vector<Index>> chunks_;
    Array built_x_, built_y_, built_z_;
    std::uint64_t builds_ = 0;
};

} // namespace cupel::inline CUPEL_ENGINE
