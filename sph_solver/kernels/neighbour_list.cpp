#include "kernels/neighbour_list.hpp"
#include "kernels/field_lanes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

/// Clusters whose lists share one array: enough of them to spread over any number of threads.
constexpr Index clusters_per_chunk = 256;

/// Consecutive coordinates, measured from `middle`: differences are taken in double, so that float loses nothing.
Lanes lanes_from(const Array& coordinate, Index first, double middle)
{
    Lanes::Register lanes;
    const double* values = coordinate.data() + first;
    for (int lane = 0; lane < lane_count; ++lane)
        lanes[lane] = static_cast<Real>(values[lane] - middle);
    return Lanes(lanes);
}

/// How far a coordinate lies beyond ±half.
Lanes outside(const Lanes& coordinate, double half)
{
    return maximum(maximum(coordinate - half, -coordinate - half), 0.0);
}

} // namespace

NeighbourList::NeighbourList(double support, double skin, double spacing, int dimensions)
    : support_(support), skin_(skin),
      column_width_(spacing * (dimensions == 2 ? std::sqrt(double(lane_count)) : std::cbrt(double(lane_count))))
{}

Index NeighbourList::column_x(double x) const
{
    return std::clamp(static_cast<Index>(std::floor((x - lower_.x) / column_width_)), Index{0}, columns_x_ - 1);
}
Index NeighbourList::column_y(double y) const
{
    return std::clamp(static_cast<Index>(std::floor((y - lower_.y) / column_width_)), Index{0}, columns_y_ - 1);
}

void NeighbourList::build(Particles& particles)
{
    sort_into_columns(particles);
    find_neighbours(particles);
    built_x_ = particles.position.x;
    built_y_ = particles.position.y;
    built_z_ = particles.position.z;
    ++builds_;
}

void NeighbourList::sort_into_columns(Particles& particles)
{
    const Index count = particles.count();
    const auto& position = particles.position;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    upper_ = {-infinity, -infinity, -infinity};
    lower_ = {infinity, infinity, infinity};
    for (Index i = 0; i < count; ++i) {
        const Vector p = position[i];
        lower_ = {std::min(lower_.x, p.x), std::min(lower_.y, p.y), std::min(lower_.z, p.z)};
        upper_ = {std::max(upper_.x, p.x), std::max(upper_.y, p.y), std::max(upper_.z, p.z)};
    }
    const double columns_x = std::floor((upper_.x - lower_.x) / column_width_) + 1.0;
    const double columns_y = std::floor((upper_.y - lower_.y) / column_width_) + 1.0;
    if (!(columns_x * columns_y < 1e8))
        throw std::runtime_error("particles are spread over more than 10^8 columns: the run has blown up");
    columns_x_ = static_cast<Index>(columns_x);
    columns_y_ = static_cast<Index>(columns_y);

    const auto columns = static_cast<std::size_t>(columns_x_) * static_cast<std::size_t>(columns_y_);
    std::vector<Index> column_of(static_cast<std::size_t>(count)), begin(columns + 1, 0);
    for (Index i = 0; i < count; ++i) {
        const Vector p = position[i];
        const Index column = column_y(p.y) * columns_x_ + column_x(p.x);
        column_of[static_cast<std::size_t>(i)] = column;
        ++begin[static_cast<std::size_t>(column) + 1];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<Index> order(static_cast<std::size_t>(count)), next(begin.begin(), begin.end() - 1);
    for (Index i = 0; i < count; ++i)
        order[static_cast<std::size_t>(next[static_cast<std::size_t>(column_of[static_cast<std::size_t>(i)])]++)] = i;

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

    clusters_.clear();
    first_cluster_of_column_.assign(columns + 1, 0);
    for (std::size_t column = 0; column < columns; ++column) {
        for (Index first = begin[column]; first < begin[column + 1]; first += lane_count)
            clusters_.push_back({first, std::min<Index>(lane_count, begin[column + 1] - first)});
        first_cluster_of_column_[column + 1] = static_cast<Index>(clusters_.size());
    }
}

void NeighbourList::find_neighbours(const Particles& particles)
{
    const Index count = cluster_count();
    boxes_.resize(clusters_.size());
    ranges_.resize(clusters_.size());
    const Index chunk_count = (count + clusters_per_chunk - 1) / clusters_per_chunk;
    chunks_.resize(static_cast<std::size_t>(chunk_count));

#pragma omp parallel
    {
#pragma omp for schedule(static)
        for (Index c = 0; c < count; ++c) {
            const Cluster& cluster = clusters_[static_cast<std::size_t>(c)];
            Box box{particles.position[cluster.first], particles.position[cluster.first]};
            for (Index i = cluster.first; i < cluster.first + cluster.count; ++i) {
                const Vector p = particles.position[i];
                box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y), std::min(box.lower.z, p.z)};
                box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y), std::max(box.upper.z, p.z)};
            }
            boxes_[static_cast<std::size_t>(c)] = box;
        }
        std::vector<Index> candidates;
#pragma omp for schedule(dynamic)
        for (Index chunk = 0; chunk < chunk_count; ++chunk) {
            auto& found = chunks_[static_cast<std::size_t>(chunk)];
            found.clear();
            const Index end = std::min(count, (chunk + 1) * clusters_per_chunk);
            for (Index c = chunk * clusters_per_chunk; c < end; ++c) {
                const std::size_t begin = found.size();
                list_cluster(particles, c, candidates, found);
                ranges_[static_cast<std::size_t>(c)] = {chunk, begin, static_cast<Index>(found.size() - begin)};
            }
        }
    }
}

/// Two sieves: a whole cluster of candidates at once against the box of this one, then each that is left against its
/// particles, which leaves out the corners of the box.
void NeighbourList::list_cluster(const Particles& particles, Index c, std::vector<Index>& candidates,
                                 std::vector<Index>& found) const
{
    const double reach = support_ + skin_;
    const auto& position = particles.position;
    const Box& box = boxes_[static_cast<std::size_t>(c)];
    const Cluster& cluster = clusters_[static_cast<std::size_t>(c)];
    const Vector middle = 0.5 * (box.lower + box.upper), half = 0.5 * (box.upper - box.lower);
    // Rounded to float, a distance may seem longer than it is by a few 10⁻⁷ of the offsets that it is made of.
    const double margin = sizeof(Real) == 4 ? 1e-5 : 1e-14;
    const double reach_squared = reach * reach * (1.0 + margin);

    candidates.clear();
    for (Index cy = column_y(box.lower.y - reach); cy <= column_y(box.upper.y + reach); ++cy)
        for (Index cx = column_x(box.lower.x - reach); cx <= column_x(box.upper.x + reach); ++cx) {
            const auto column =
                static_cast<std::size_t>(cy) * static_cast<std::size_t>(columns_x_) + static_cast<std::size_t>(cx);
            for (Index d = first_cluster_of_column_[column]; d < first_cluster_of_column_[column + 1]; ++d) {
                const Box& other = boxes_[static_cast<std::size_t>(d)];
                if (other.upper.z < box.lower.z - reach) continue;
                if (other.lower.z > box.upper.z + reach) break;
                const Cluster& near = clusters_[static_cast<std::size_t>(d)];
                const VectorLanes beyond{outside(lanes_from(position.x, near.first, middle.x), half.x),
                                         outside(lanes_from(position.y, near.first, middle.y), half.y),
                                         outside(lanes_from(position.z, near.first, middle.z), half.z)};
                unsigned within = set_lanes(dot(beyond, beyond) < reach_squared) & ((1u << near.count) - 1u);
                for (; within != 0; within &= within - 1)
                    candidates.push_back(near.first + std::countr_zero(within));
            }
        }

    VectorLanes here{lanes_from(position.x, cluster.first, middle.x), lanes_from(position.y, cluster.first, middle.y),
                     lanes_from(position.z, cluster.first, middle.z)};
    for (int lane = cluster.count; lane < lane_count; ++lane) {
        here.x.set(lane, here.x[0]);
        here.y.set(lane, here.y[0]);
        here.z.set(lane, here.z[0]);
    }
    const std::size_t before = found.size();
    found.resize(before + candidates.size());
    Index* end = found.data() + before;
    for (const Index j : candidates) {
        const VectorLanes offset = here - broadcast(position[j] - middle);
        *end = j;
        end += set_lanes(dot(offset, offset) < reach_squared) != 0 ? 1 : 0;
    }
    found.resize(static_cast<std::size_t>(end - found.data()));
}

bool NeighbourList::outdated(const Particles& particles, std::span<const Index> moving) const
{
    if (clusters_.empty()) return true;
    const double limit = 0.25 * skin_ * skin_;
    bool moved = false;
    const auto& position = particles.position;
    const std::size_t count = moving.size();
#pragma omp parallel for schedule(static) reduction(|| : moved)
    for (std::size_t m = 0; m < count; ++m) {
        const auto k = static_cast<std::size_t>(moving[m]);
        const double dx = position.x[k] - built_x_[k], dy = position.y[k] - built_y_[k],
                     dz = position.z[k] - built_z_[k];
        // Negated, so that a position that is not a number counts as moved and the guards see it.
        moved = moved || !(dx * dx + dy * dy + dz * dz <= limit);
    }
    return moved;
}

std::size_t NeighbourList::bytes() const
{
    std::size_t total = clusters_.size() * (sizeof(Cluster) + sizeof(Box) + sizeof(Range));
    for (const auto& chunk : chunks_)
        total += chunk.capacity() * sizeof(Index);
    return total + 3 * built_x_.size() * sizeof(double);
}

} // namespace cupel::inline CUPEL_ENGINE
