#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "kernels/cluster_boxes.hpp"
#include "kernels/images.hpp"
#include "math/lanes.hpp"
#include "particles/particles.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Consecutive particles (at most lane_count) that share one list of neighbours.
struct Cluster
{
    Index first;
    Index count;

    unsigned lanes() const { return (1u << count) - 1u; } ///< a bit for each particle
};

/// Some of 16 particles that follow each other, of one cluster or of several: bit k stands for the one at first + k. A
/// list of these is an eighth as long as one of particles, and turns into one without a branch.
struct Listed
{
    static constexpr Index most = 16;

    Index first;
    std::uint32_t lanes;

    Index count() const { return std::popcount(lanes); }
    template <class Visit> void for_each(const Visit& visit) const
    {
        for (std::uint32_t left = lanes; left != 0; left &= left - 1)
            visit(first + std::countr_zero(left));
    }
};

inline Index neighbours_in(std::span<const Listed> list)
{
    return std::accumulate(list.begin(), list.end(), Index{0},
                           [](Index sum, const Listed& some) { return sum + some.count(); });
}

/// Particles, one after the other in memory, that are seen as an image, beyond a periodic or a symmetry side.
struct ImageRun
{
    Index first;
    Index count;
    Index image; ///< of NeighbourList::images()
};

/// Orders particles in vertical columns and keeps, for each cluster, the particles within
/// support + skin of any of them. A list stays valid while no particle has moved further than skin/2 since it was
/// built: two particles that were further apart than support + skin then are still further apart than the support.
class NeighbourList
{
public:
    /// support and skin in m; dimensions 2 or 3; spacing is the particle spacing that sets the width of a column.
    NeighbourList(double support, double skin, double spacing, int dimensions, Images images = {});

    /// Brings particles that have left through a periodic side back through the other one, sorts all into columns, cuts
    /// clusters and lists their neighbours.
    void build(Particles& particles);

    /// Lists anew what the particles of the clusters `moved` concern, in place: order and clusters stay, and so do the
    /// lists elsewhere. `moved` names every cluster with a particle that is not where it was when last listed. False
    /// where a build() is needed instead: much has moved, or clusters have spread.
    bool refresh(const Particles& particles, std::span<const Index> moved);

    /// Whether one of the particles that move (places) has moved further than half the skin since it was listed.
    bool outdated(const Particles& particles, std::span<const Index> moving) const;

    Index cluster_count() const { return static_cast<Index>(clusters_.size()); }
    const Cluster& cluster(Index c) const { return clusters_[static_cast<std::size_t>(c)]; }
    Index cluster_of(Index particle) const { return cluster_of_[static_cast<std::size_t>(particle)]; }
    /// The particles near a cluster, none of them twice.
    std::span<const Listed> near(Index c) const
    {
        const auto& range = ranges_[static_cast<std::size_t>(c)];
        if (range.chunk == own_list) return own_lists_[static_cast<std::size_t>(c)];
        return {chunks_[static_cast<std::size_t>(range.chunk)].data() + range.begin,
                static_cast<std::size_t>(range.count)};
    }
    const Images& images() const { return images_; }
    /// What a cluster sees beyond periodic and symmetry sides; empty for nearly all, and for all where there are none.
    std::span<const ImageRun> image_runs(Index c) const
    {
        if (image_runs_.empty()) return {};
        return image_runs_[static_cast<std::size_t>(c)];
    }
    /// Whether a pass may leave out clusters for which its terms have nothing to do.
    bool skips_idle() const { return skips_idle_; }
    void skip_nothing() { skips_idle_ = false; }
    /// visit(cluster, k) for each cluster of which some are listed: its first particle would be bit k.
    template <class Visit> void for_each_cluster_of(const Listed& some, const Visit& visit) const
    {
        Index c = cluster_of(some.first);
        for (Index k = 0; some.lanes >> k != 0; k += cluster(c++).count)
            visit(c, k);
    }
    /// Every particle that is near as itself.
    template <class Visit> void for_each_listed(Index c, const Visit& visit) const
    {
        for (const Listed& some : near(c))
            some.for_each(visit);
    }
    /// Every particle that is near as itself, then every one that is near as an image (again, if need be).
    template <class Visit> void for_each_neighbour(Index c, const Visit& visit) const
    {
        for_each_listed(c, visit);
        for (const ImageRun& run : image_runs(c))
            for (Index j = run.first; j < run.first + run.count; ++j)
                visit(j);
    }
    /// Which clusters these see something of, a mark for each.
    std::vector<unsigned char> seen_from(std::span<const Index> clusters) const;
    std::uint64_t builds() const { return builds_; }
    std::uint64_t refreshes() const { return refreshes_; }
    double support() const { return support_; }
    double skin() const { return skin_; }
    /// Corners of the box that the particles spanned when they were last listed, m.
    const Vector& lower() const { return lower_; }
    const Vector& upper() const { return upper_; }
    std::size_t bytes() const;

private:
    struct Range
    {
        Index chunk; ///< own_list where refresh() has given the cluster a list of its own
        std::size_t begin;
        Index count;
        Index neighbours; ///< when the list was built
    };
    struct Box
    {
        Vector lower, upper;
    };
    static constexpr Index own_list = -1;

    void sort_into_columns(Particles& particles);
    void cut_clusters(const std::vector<Index>& first_of_column);
    void find_neighbours(const Particles& particles);
    void list_cluster(const Particles& particles, Index c, std::vector<Listed>& found) const;
    void list_images(const Particles& particles, Index c);
    void spread_loose_over_columns();
    std::vector<Index> clusters_near(std::span<const Index> moved) const;
    template <class Visit> void for_each_cluster_near(const Box& box, const Visit& visit) const;
    Box box_of(const Particles& particles, Index c) const;
    static Box image_of(const Box& box, const Image& image);
    Index column_x(double x) const { return column((x - origin_.x) / column_width_, columns_x_); }
    Index column_y(double y) const { return column((y - origin_.y) / column_width_, columns_y_); }
    /// Of `count` columns the one that a place is in, or the outermost; the first where it is no number.
    static Index column(double place, Index count)
    {
        return place > 0.0 ? static_cast<Index>(std::min(place, static_cast<double>(count - 1))) : 0;
    }
    /// Columns are numbered in strips of a few along x, each of them row after row along y: what a cluster sees was
    /// seen not long before, and is still in the nearer caches.
    std::size_t column_at(Index cx, Index cy) const
    {
        constexpr Index strip = 8;
        const Index first = cx / strip * strip, width = std::min(strip, columns_x_ - first);
        return static_cast<std::size_t>(first) * static_cast<std::size_t>(columns_y_) +
               static_cast<std::size_t>(cy * width + cx - first);
    }

    double support_, skin_, column_width_;
    Images images_;
    std::vector<std::vector<ImageRun>> image_runs_; ///< by cluster; empty where there are no images at all
    Vector origin_{}, lower_{}, upper_{};
    Index columns_x_ = 0, columns_y_ = 0;
    std::vector<Index> first_cluster_of_column_, cluster_of_;
    std::vector<Cluster> clusters_;
    std::vector<Box> boxes_;
    ClusterBoxes boxes_in_columns_; ///< from origin_, without those of loose clusters
    std::vector<Range> ranges_;
    std::vector<std::vector<Listed>> chunks_;
    Array built_x_, built_y_, built_z_;
    std::uint64_t builds_ = 0, refreshes_ = 0;
    bool skips_idle_ = true;

    // Clusters that have moved since the build: no longer in the column, nor at the height, that they were sorted to.
    std::vector<std::vector<Listed>> own_lists_;
    std::vector<unsigned char> is_loose_;
    std::vector<Index> loose_;
    std::vector<Index> first_loose_of_column_, loose_of_column_; ///< those whose box reaches into a column
};

} // namespace cupel::inline CUPEL_ENGINE
