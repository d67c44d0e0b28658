#pragma once

#include <span>
#include <tuple>
#include <utility>

#include "kernels/neighbour_list.hpp"
#include "kernels/smoothing_kernel.hpp"
#include "particles/particles.hpp"

namespace cupel
{

/// What the loop knows of a pair (i, j), for eight particles i at once.
struct Pair
{
    VectorLanes offset;    ///< x_i − x_j, m
    Lanes distance;        ///< |x_i − x_j|, m; never zero
    Lanes kernel;          ///< W_ij
    Lanes gradient_over_r; ///< (1/r) dW/dr, so that ∇_i W_ij = gradient_over_r · offset

    VectorLanes gradient() const { return gradient_over_r * offset; }
};

/// Sums over neighbours, several of them in one pass. A term is a struct with
///
///   struct Near                              what a term needs of particle i (eight of them, in lanes)
///   struct Sum                               what it adds up, zero to begin with
///   Near near(Index first) const             loads it
///   bool idle(Cluster) const                 true where the term has nothing to do for this cluster
///   void add(const Near&, Index j, const Pair&, Sum&) const      the formula
///   void store(Cluster, const Near&, const Sum&) const           keeps the sum
///
/// The particle itself is among its neighbours (distance zero, gradient zero, W = W(0)). Each sum is added up by one
/// thread in the order of the list, so the result does not depend on the number of threads.
template <class Kernel, class... Terms>
void for_each_pair(const NeighbourList& list, const Particles& particles, const Kernel& kernel,
                   std::span<const Index> clusters, const Terms&... terms)
{
    const auto count = static_cast<Index>(clusters.size());
    const double tiny = 1e-18 * list.support() * list.support();
    const auto& position = particles.position;
#pragma omp parallel for schedule(dynamic, 16)
    for (Index k = 0; k < count; ++k) {
        const Index c = clusters[static_cast<std::size_t>(k)];
        const Cluster cluster = list.cluster(c);
        if ((terms.idle(cluster) && ...)) continue;
        const VectorLanes here = position.lanes(cluster.first);
        const std::tuple<typename Terms::Near...> near{terms.near(cluster.first)...};
        std::tuple<typename Terms::Sum...> sums{};
        for (const Index j : list.neighbours(c)) {
            Pair pair;
            pair.offset = here - broadcast(position[j]);
            pair.distance = square_root(dot(pair.offset, pair.offset) + tiny);
            const auto w = kernel(pair.distance);
            pair.kernel = w.value;
            pair.gradient_over_r = w.gradient_over_r;
            [&]<std::size_t... n>(std::index_sequence<n...>)
            {
                (terms.add(std::get<n>(near), j, pair, std::get<n>(sums)), ...);
            }
            (std::index_sequence_for<Terms...>{});
        }
        [&]<std::size_t... n>(std::index_sequence<n...>)
        {
            (terms.store(cluster, std::get<n>(near), std::get<n>(sums)), ...);
        }
        (std::index_sequence_for<Terms...>{});
    }
}

/// Sum of value(i) over all particles, added in blocks of fixed size so that the number of threads does not matter.
template <class Value> double ordered_sum(Index count, const Value& value)
{
    constexpr Index block = 4096;
    const Index blocks = (count + block - 1) / block;
    std::vector<double> partial(static_cast<std::size_t>(blocks), 0.0);
#pragma omp parallel for schedule(static)
    for (Index b = 0; b < blocks; ++b) {
        const Index end = std::min(count, (b + 1) * block);
        double sum = 0.0;
        for (Index i = b * block; i < end; ++i)
            sum += value(i);
        partial[static_cast<std::size_t>(b)] = sum;
    }
    double total = 0.0;
    for (const double sum : partial)
        total += sum;
    return total;
}

} // namespace cupel
