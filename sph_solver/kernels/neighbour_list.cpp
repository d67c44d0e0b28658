#include "kernels/neighbour_list.hpp"
#include "kernels/cluster_sieve.hpp"
#include "kernels/stretches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

/// Clusters whose lists share one array: enough of them to spread over any number of threads.
constexpr Index clusters_per_chunk = 256;

/// A refresh pays while it concerns less than this share of the clusters, and while the lists of what moves, whose
/// clusters spread, have not grown by more than this factor since the build. Both found by timing, neither is sharp.
constexpr double greatest_share = 0.4, greatest_growth = 1.3;

Vector least(const Vector& a, const Vector& b)
{
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vector most(const Vector& a, const Vector& b)
{
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

} // namespace

NeighbourList::NeighbourList(double support, double skin, double spacing, int dimensions, Images images)
    : support_(support), skin_(skin),
      column_width_(spacing * (dimensions == 2 ? std::sqrt(double(lane_count)) : std::cbrt(double(lane_count)))),
      images_(std::move(images))
{}

void NeighbourList::build(Particles& particles)
{
    if (images_.any())
        for (Index i = 0; i < particles.count(); ++i)
            particles.position.set(i, images_.wrapped(particles.position[i]));
    sort_into_columns(particles);
    find_neighbours(particles);
    const std::size_t places = particles.position.x.size();
    for (Array* built : {&built_x_, &built_y_, &built_z_})
        built->resize(places);
#pragma omp parallel for schedule(static) if (places > 8192)
    for (std::size_t k = 0; k < places; ++k) {
        built_x_[k] = particles.position.x[k];
        built_y_[k] = particles.position.y[k];
        built_z_[k] = particles.position.z[k];
    }
    ++builds_;
}

NeighbourList::Box NeighbourList::box_of(const Particles& particles, Index c) const
{
    const Cluster& cluster = clusters_[static_cast<std::size_t>(c)];
    Box box{particles.position[cluster.first], particles.position[cluster.first]};
    for (Index i = cluster.first + 1; i < cluster.first + cluster.count; ++i) {
        const Vector p = particles.position[i];
        box = {least(box.lower, p), most(box.upper, p)};
    }
    return box;
}

void NeighbourList::find_neighbours(const Particles& particles)
{
    const Index count = cluster_count();
    boxes_.resize(clusters_.size());
    ranges_.resize(clusters_.size());
    boxes_in_columns_.resize(clusters_.size());
    const Index chunk_count = (count + clusters_per_chunk - 1) / clusters_per_chunk;
    chunks_.resize(static_cast<std::size_t>(chunk_count));
    if (images_.any()) image_runs_.assign(clusters_.size(), {});
    Stretches chunks(chunk_count, 1);

#pragma omp parallel
    {
#pragma omp for schedule(static)
        for (Index c = 0; c < count; ++c) {
            const Box& box = boxes_[static_cast<std::size_t>(c)] = box_of(particles, c);
            boxes_in_columns_.set(c, box.lower - origin_, box.upper - origin_);
        }
        chunks.for_each([&](Index chunk) {
            auto& found = chunks_[static_cast<std::size_t>(chunk)];
            found.clear();
            const Index end = std::min(count, (chunk + 1) * clusters_per_chunk);
            for (Index c = chunk * clusters_per_chunk; c < end; ++c) {
                const std::size_t begin = found.size();
                list_cluster(particles, c, found);
                list_images(particles, c);
                const std::span<const Listed> near{found.data() + begin, found.size() - begin};
                ranges_[static_cast<std::size_t>(c)] = {chunk, begin, static_cast<Index>(near.size()),
                                                        neighbours_in(near)};
            }
            // Growing by doubling leaves up to half of it unused.
            if (found.capacity() > found.size() + found.size() / 8) found.shrink_to_fit();
        });
    }
}

/// Clusters whose boxes come within reach of this box, in an order that depends on nothing but columns and boxes.
template <class Visit> void NeighbourList::for_each_cluster_near(const Box& box, const Visit& visit) const
{
    const double reach = support_ + skin_;
    const double reach_squared = reach * reach * (1.0 + 1e-12);
    const Vector lower = box.lower - origin_, upper = box.upper - origin_;
    const Index x0 = column_x(box.lower.x - reach), x1 = column_x(box.upper.x + reach);
    const Index y0 = column_y(box.lower.y - reach), y1 = column_y(box.upper.y + reach);
    const auto near = [&](const Box& other) {
        const double x = std::max({0.0, box.lower.x - other.upper.x, other.lower.x - box.upper.x});
        const double y = std::max({0.0, box.lower.y - other.upper.y, other.lower.y - box.upper.y});
        const double z = std::max({0.0, box.lower.z - other.upper.z, other.lower.z - box.upper.z});
        return x * x + y * y + z * z < reach_squared;
    };
    for (Index cy = y0; cy <= y1; ++cy)
        for (Index cx = x0; cx <= x1; ++cx) {
            const std::size_t column = column_at(cx, cy);
            const Index end = first_cluster_of_column_[column + 1];
            Index d = first_cluster_of_column_[column];
            if (loose_.empty() && end - d > 4 * ClusterBoxes::at_once)
                // A column's clusters are in order of height until some have moved.
                d = static_cast<Index>(
                    std::partition_point(boxes_.begin() + d, boxes_.begin() + end,
                                         [&](const Box& other) { return other.upper.z < box.lower.z - reach; }) -
                    boxes_.begin());
            for (; d < end; d += ClusterBoxes::at_once) {
                unsigned found =
                    boxes_in_columns_.near(d, end, lower, upper, static_cast<float>(reach_squared * 1.00001));
                for (; found != 0; found &= found - 1)
                    visit(d + std::countr_zero(found));
                if (boxes_[static_cast<std::size_t>(d)].lower.z > box.upper.z + reach &&
                    !is_loose_[static_cast<std::size_t>(d)])
                    break;
            }
            for (Index k = first_loose_of_column_[column]; k < first_loose_of_column_[column + 1]; ++k) {
                const Index d = loose_of_column_[static_cast<std::size_t>(k)];
                const Box& other = boxes_[static_cast<std::size_t>(d)];
                // It may reach into several of the columns looked at: the first of them counts.
                if (cx == std::max(x0, column_x(other.lower.x)) && cy == std::max(y0, column_y(other.lower.y)) &&
                    near(other))
                    visit(d);
            }
        }
}

/// Two sieves: boxes of clusters against the box of this one, then a whole cluster of candidates at once against each
/// of this one's particles.
void NeighbourList::list_cluster(const Particles& particles, Index c, std::vector<Listed>& found) const
{
    const double reach = support_ + skin_;
    const auto& position = particles.position;
    const Box& box = boxes_[static_cast<std::size_t>(c)];
    const Cluster& cluster = clusters_[static_cast<std::size_t>(c)];
    const Vector middle = 0.5 * (box.lower + box.upper);
    // Rounded to float, a distance may seem longer than it is by a few 10⁻⁷ of the offsets that it is made of.
    const auto reach_squared = static_cast<float>(reach * reach * (1.0 + 1e-5));

    // Each register holds one particle of this cluster, or two of them in double; what is missing is its last once
    // more.
    constexpr int registers = lane_count / particles_at_a_time;
    Filled x[registers], y[registers], z[registers];
    for (int lane = 0; lane < lane_count; ++lane) {
        const Vector p = position[cluster.first + std::min<Index>(lane, cluster.count - 1)] - middle;
        for (int candidate = 0; candidate < lane_count; ++candidate) {
            const int place = (lane % particles_at_a_time) * lane_count + candidate;
            set_number_at(x[lane / particles_at_a_time], place, static_cast<float>(p.x));
            set_number_at(y[lane / particles_at_a_time], place, static_cast<float>(p.y));
            set_number_at(z[lane / particles_at_a_time], place, static_cast<float>(p.z));
        }
    }
    const std::size_t before = found.size();
    for_each_cluster_near(box, [&](Index d) {
        const Cluster& near = clusters_[static_cast<std::size_t>(d)];
        const Filled near_x = filled(narrow(position.x, near.first, middle.x)),
                     near_y = filled(narrow(position.y, near.first, middle.y)),
                     near_z = filled(narrow(position.z, near.first, middle.z));
        Filled nearest = packed<Filled>(reach_squared);
        for (int k = 0; k < registers; ++k) {
            const Filled dx = near_x - x[k], dy = near_y - y[k], dz = near_z - z[k];
            nearest = lesser(dx * dx + (dy * dy + dz * dz), nearest);
        }
        const std::uint32_t reached = candidates_below(nearest, reach_squared) & ((1u << near.count) - 1u);
        if (reached == 0) return;
        // With the clusters below it in its column, as far as there is room for them.
        const Index above = found.size() > before ? near.first - found.back().first : 0;
        if (above > 0 && above + near.count <= Listed::most)
            found.back().lanes |= reached << above;
        else
            found.push_back({near.first, reached});
    });
}

NeighbourList::Box NeighbourList::image_of(const Box& box, const Image& image)
{
    const Vector a = image.place(box.lower), b = image.place(box.upper);
    return {least(a, b), most(a, b)};
}

/// Particles whose images are near a cluster. Few clusters have any: they are found by boxes, then one by one.
void NeighbourList::list_images(const Particles& particles, Index c)
{
    if (!images_.any()) return;
    const double reach = support_ + skin_, reach_squared = reach * reach * (1.0 + 1e-12);
    const Cluster& cluster = clusters_[static_cast<std::size_t>(c)];
    const Box& box = boxes_[static_cast<std::size_t>(c)];
    auto& found = image_runs_[static_cast<std::size_t>(c)];
    found.clear();
    for (std::size_t k = 0; k < images_.count(); ++k) {
        const Image& image = images_[k];
        // What sees an image of d has its own image near d, by the image that undoes the first.
        const Box seen_from = image_of(box, image.inverse());
        for_each_cluster_near(seen_from, [&](Index d) {
            const Cluster& near = clusters_[static_cast<std::size_t>(d)];
            for (Index j = near.first; j < near.first + near.count; ++j) {
                const Vector place = image.place(particles.position[j]);
                bool reached = false;
                for (Index i = cluster.first; i < cluster.first + cluster.count && !reached; ++i) {
                    const Vector offset = particles.position[i] - place;
                    reached = dot(offset, offset) < reach_squared;
                }
                if (!reached) continue;
                if (!found.empty() && found.back().image == static_cast<Index>(k) &&
                    found.back().first + found.back().count == j)
                    ++found.back().count;
                else
                    found.push_back({j, 1, static_cast<Index>(k)});
            }
        });
    }
}

bool NeighbourList::outdated(const Particles& particles, std::span<const Index> moving) const
{
    if (clusters_.empty()) return true;
    const double limit = 0.25 * skin_ * skin_;
    bool moved = false;
    const auto& position = particles.position;
    const std::size_t count = moving.size();
#pragma omp parallel for schedule(static) reduction(|| : moved) if (count > 4096)
    for (std::size_t m = 0; m < count; ++m) {
        const auto k = static_cast<std::size_t>(moving[m]);
        const double dx = position.x[k] - built_x_[k], dy = position.y[k] - built_y_[k],
                     dz = position.z[k] - built_z_[k];
        // Negated, so that a position that is not a number counts as moved and the guards see it.
        moved = moved || !(dx * dx + dy * dy + dz * dz <= limit);
    }
    return moved;
}

/// Every loose cluster into each column that its box reaches into.
void NeighbourList::spread_loose_over_columns()
{
    const auto for_each_column = [&](Index d, const auto& visit) {
        const Box& box = boxes_[static_cast<std::size_t>(d)];
        for (Index cy = column_y(box.lower.y); cy <= column_y(box.upper.y); ++cy)
            for (Index cx = column_x(box.lower.x); cx <= column_x(box.upper.x); ++cx)
                visit(column_at(cx, cy));
    };
    std::vector<Index>& first = first_loose_of_column_;
    std::fill(first.begin(), first.end(), 0);
    for (const Index d : loose_)
        for_each_column(d, [&](std::size_t column) { ++first[column + 1]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    loose_of_column_.resize(static_cast<std::size_t>(first.back()));
    std::vector<Index> next(first.begin(), first.end() - 1);
    for (const Index d : loose_)
        for_each_column(d, [&](std::size_t column) { loose_of_column_[static_cast<std::size_t>(next[column]++)] = d; });
}

std::vector<Index> NeighbourList::clusters_near(std::span<const Index> moved) const
{
    std::vector<unsigned char> near(clusters_.size(), 0);
    const auto mark = [&](Index d) { near[static_cast<std::size_t>(d)] = 1; };
    for (const Index c : moved) {
        const Box& box = boxes_[static_cast<std::size_t>(c)];
        for_each_cluster_near(box, mark);
        for (std::size_t k = 0; k < images_.count(); ++k)
            for_each_cluster_near(image_of(box, images_[k]), mark);
    }
    std::vector<Index> found;
    for (std::size_t c = 0; c < near.size(); ++c)
        if (near[c]) found.push_back(static_cast<Index>(c));
    return found;
}

/// Why this is enough: a list that stays as it was belongs to a cluster that has not moved and to which nothing that
/// has moved has come near; what has gone away from it may still be listed, and counts for nothing beyond the support.
/// From here on the places of `moved` are where they are now: no two particles come nearer than by the skin before one
/// of them has moved by half of it.
bool NeighbourList::refresh(const Particles& particles, std::span<const Index> moved)
{
    const auto most_clusters = static_cast<std::size_t>(greatest_share * static_cast<double>(clusters_.size()));
    if (moved.size() > most_clusters) return false;
    for (const Index c : moved) {
        const Box& box = boxes_[static_cast<std::size_t>(c)] = box_of(particles, c);
        if (!std::isfinite(dot(box.upper - box.lower, box.upper - box.lower))) return false;
        if (images_.must_wrap(box.lower, box.upper)) return false;
        lower_ = least(lower_, box.lower);
        upper_ = most(upper_, box.upper);
        if (!is_loose_[static_cast<std::size_t>(c)]) loose_.push_back(c);
        is_loose_[static_cast<std::size_t>(c)] = 1;
        boxes_in_columns_.put_out_of_reach(c);
    }
    std::sort(loose_.begin(), loose_.end());
    spread_loose_over_columns();
    const std::vector<Index> concerned = clusters_near(moved);
    if (concerned.size() > most_clusters) return false;

    Stretches stretches(static_cast<Index>(concerned.size()), 8);
    by_all_threads(concerned.size() > 32, [&] {
        stretches.for_each([&](Index k) {
            const Index c = concerned[static_cast<std::size_t>(k)];
            own_lists_[static_cast<std::size_t>(c)].clear();
            list_cluster(particles, c, own_lists_[static_cast<std::size_t>(c)]);
            list_images(particles, c);
        });
    });
    double built = 0.0, now = 0.0;
    for (const Index c : moved) {
        built += ranges_[static_cast<std::size_t>(c)].neighbours;
        now += neighbours_in(own_lists_[static_cast<std::size_t>(c)]);
    }
    if (now > greatest_growth * built) return false;

    for (const Index c : concerned)
        ranges_[static_cast<std::size_t>(c)].chunk = own_list;
    for (const Index c : moved) {
        const Cluster& cluster = clusters_[static_cast<std::size_t>(c)];
        for (auto k = static_cast<std::size_t>(cluster.first);
             k < static_cast<std::size_t>(cluster.first + cluster.count); ++k) {
            built_x_[k] = particles.position.x[k];
            built_y_[k] = particles.position.y[k];
            built_z_[k] = particles.position.z[k];
        }
    }
    ++refreshes_;
    return true;
}

std::size_t NeighbourList::bytes() const
{
    std::size_t total = clusters_.size() * (sizeof(Cluster) + sizeof(Box) + sizeof(Range) + sizeof(own_lists_[0]) + 1) +
                        cluster_of_.size() * sizeof(Index);
    for (const auto* lists : {&chunks_, &own_lists_})
        for (const auto& list : *lists)
            total += list.capacity() * sizeof(Listed);
    for (const auto& list : image_runs_)
        total += sizeof(list) + list.capacity() * sizeof(ImageRun);
    return total + boxes_in_columns_.bytes() + 3 * built_x_.size() * sizeof(double);
}

std::vector<unsigned char> NeighbourList::seen_from(std::span<const Index> clusters) const
{
    std::vector<unsigned char> seen(clusters_.size(), 0);
    for (const Index c : clusters) {
        for (const Listed& some : near(c))
            for_each_cluster_of(some, [&](Index d, Index) { seen[static_cast<std::size_t>(d)] = 1; });
        for (const ImageRun& run : image_runs(c))
            for (Index j = run.first; j < run.first + run.count; ++j)
                seen[static_cast<std::size_t>(cluster_of(j))] = 1;
    }
    return seen;
}

} // namespace cupel::inline CUPEL_ENGINE
