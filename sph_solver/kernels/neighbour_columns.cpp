/// The order of particles in memory: columns, and clusters cut from them.
#include "kernels/neighbour_list.hpp"
#include "kernels/neighbour_records.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <omp.h>

namespace cupel::inline CUPEL_ENGINE
{

void NeighbourList::sort_into_columns(Particles& particles)
{
    const Index count = particles.count();
    const auto& position = particles.position;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double x0 = infinity, y0 = infinity, z0 = infinity, x1 = -infinity, y1 = -infinity, z1 = -infinity;
#pragma omp parallel for schedule(static) reduction(min : x0, y0, z0) reduction(max : x1, y1, z1) if (count > 8192)
    for (Index i = 0; i < count; ++i) {
        const Vector p = position[i];
        x0 = std::min(x0, p.x);
        y0 = std::min(y0, p.y);
        z0 = std::min(z0, p.z);
        x1 = std::max(x1, p.x);
        y1 = std::max(y1, p.y);
        z1 = std::max(z1, p.z);
    }
    lower_ = origin_ = {x0, y0, z0};
    upper_ = {x1, y1, z1};
    const double columns_x = std::floor((upper_.x - lower_.x) / column_width_) + 1.0;
    const double columns_y = std::floor((upper_.y - lower_.y) / column_width_) + 1.0;
    if (!(columns_x * columns_y < 1e8))
        throw std::runtime_error("particles are spread over more than 10^8 columns: the run has blown up");
    columns_x_ = static_cast<Index>(columns_x);
    columns_y_ = static_cast<Index>(columns_y);

    const auto columns = static_cast<std::size_t>(columns_x_) * static_cast<std::size_t>(columns_y_);
    std::vector<Index> begin(columns + 1, 0);
    // No pass is under way: its memory holds what would otherwise be made anew, page by page, each time.
    auto* const lent = reinterpret_cast<Index*>(pass_memory(2 * sizeof(Index) * static_cast<std::size_t>(count)));
    const std::span<Index> column_of(lent, static_cast<std::size_t>(count));
    const std::span<Index> order(lent + count, static_cast<std::size_t>(count));
    // Each thread counts a share of the particles, and later puts them into its share of each column.
    const bool worth_it = count > 8192 && static_cast<std::size_t>(count) > 8 * columns;
    const Index shares = worth_it ? std::min(omp_get_max_threads(), 64) : 1;
    std::vector<std::vector<Index>> next(static_cast<std::size_t>(shares));
    const auto for_each_of = [&](Index share, const auto& visit) {
        const std::int64_t all = count;
        for (auto i = static_cast<Index>(all * share / shares); i < static_cast<Index>(all * (share + 1) / shares); ++i)
            visit(i, column_of[static_cast<std::size_t>(i)]);
    };
#pragma omp parallel for schedule(static, 1) if (shares > 1)
    for (Index share = 0; share < shares; ++share) {
        auto& counted = next[static_cast<std::size_t>(share)];
        counted.assign(columns, 0);
        for_each_of(share, [&](Index i, Index& column) {
            const Vector p = position[i];
            column = static_cast<Index>(column_at(column_x(p.x), column_y(p.y)));
            ++counted[static_cast<std::size_t>(column)];
        });
    }
    for (std::size_t column = 0; column < columns; ++column) {
        Index place = begin[column];
        for (auto& counted : next)
            place += std::exchange(counted[column], place);
        begin[column + 1] = place;
    }
#pragma omp parallel for schedule(static, 1) if (shares > 1)
    for (Index share = 0; share < shares; ++share)
        for_each_of(share, [&](Index i, Index column) {
            Index& place = next[static_cast<std::size_t>(share)][static_cast<std::size_t>(column)];
            order[static_cast<std::size_t>(place++)] = i;
        });

#pragma omp parallel for schedule(dynamic, 64)
    for (std::size_t column = 0; column < columns; ++column)
        // Ties in height are settled by identity, so that the order never depends on what it was before.
        std::sort(order.begin() + begin[column], order.begin() + begin[column + 1], [&](Index a, Index b) {
            const double za = position.z[static_cast<std::size_t>(a)];
            const double zb = position.z[static_cast<std::size_t>(b)];
            return za != zb ? za < zb
                            : particles.identity[static_cast<std::size_t>(a)] <
                                  particles.identity[static_cast<std::size_t>(b)];
        });
    particles.permute(order);
    cut_clusters(begin);
}

void NeighbourList::cut_clusters(const std::vector<Index>& first_of_column)
{
    const std::size_t columns = first_of_column.size() - 1;
    first_cluster_of_column_.assign(columns + 1, 0);
    for (std::size_t column = 0; column < columns; ++column) {
        const Index count = first_of_column[column + 1] - first_of_column[column];
        first_cluster_of_column_[column + 1] = first_cluster_of_column_[column] + (count + lane_count - 1) / lane_count;
    }
    clusters_.resize(static_cast<std::size_t>(first_cluster_of_column_.back()));
    cluster_of_.resize(static_cast<std::size_t>(first_of_column.back()));
#pragma omp parallel for schedule(static) if (clusters_.size() > 1024)
    for (std::size_t column = 0; column < columns; ++column)
        for (Index c = first_cluster_of_column_[column]; c < first_cluster_of_column_[column + 1]; ++c) {
            const Index first = first_of_column[column] + (c - first_cluster_of_column_[column]) * lane_count;
            const Index count = std::min<Index>(lane_count, first_of_column[column + 1] - first);
            std::fill_n(cluster_of_.begin() + first, count, c);
            clusters_[static_cast<std::size_t>(c)] = {first, count};
        }
    is_loose_.assign(clusters_.size(), 0);
    first_loose_of_column_.assign(columns + 1, 0);
    loose_of_column_.clear();
    // Only a refresh gives lists of their own, and leaves something loose.
    if (!loose_.empty()) own_lists_.clear();
    own_lists_.resize(clusters_.size());
    loose_.clear();
}

} // namespace cupel::inline CUPEL_ENGINE
