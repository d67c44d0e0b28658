#pragma once

#include <span>
#include <tuple>
#include <utility>

#include "kernels/field_lanes.hpp"
#include "kernels/mirrored.hpp"
#include "kernels/neighbour_list.hpp"
#include "kernels/places.hpp"
#include "kernels/smoothing_kernel.hpp"
#include "particles/particles.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// What the loop knows of a pair (i, j), for a cluster of particles i at once.
struct Pair
{
    VectorLanes offset;    ///< x_i − x_j, m
    Lanes square;          ///< |x_i − x_j|², m²; never zero
    Lanes kernel;          ///< W_ij
    Lanes gradient_over_r; ///< (1/r) dW/dr, so that ∇_i W_ij = gradient_over_r · offset

    VectorLanes gradient() const { return gradient_over_r * offset; }
};

/// A term that says what it needs of a neighbour, `Far far(Index j) const`, gets that; any other gets its place j and
/// looks into the fields itself.
template <class Term>
concept HasFar = requires(const Term& term, Index j)
{
    term.far(j);
};

/// A term that takes nothing from some neighbours, most of them perhaps, says so of one: `bool ignores(Far) const`.
template <class Term>
concept Ignores = HasFar<Term> && requires(const Term& term, Index j)
{
    term.ignores(term.far(j));
};

template <class Term> bool ignores(const Term& term, [[maybe_unused]] const auto& far)
{
    if constexpr (Ignores<Term>)
        return term.ignores(far);
    else
        return false;
}

template <class Term> auto far_of(const Term& term, Index j)
{
    if constexpr (HasFar<Term>)
        return term.far(j);
    else
        return j;
}

/// What is kept of a particle for the length of a pass: all that the loop and the terms need of a neighbour, side by
/// side in memory.
template <class... Terms> struct Neighbour
{
    Place place;
    std::tuple<decltype(far_of(std::declval<const Terms&>(), Index{}))...> far;
};

/// visit(j, image, offset) for every particle that a cluster sees beyond a periodic or symmetry side. Few clusters see
/// any, so that this way is plain, and offsets are taken in double.
template <class Visit>
void for_each_image(const NeighbourList& list, std::span<const ImageRun> runs, const VectorField& position, Index first,
                    const Visit& visit)
{
    const Vector origin = position[first];
    VectorLanes here;
    for (int lane = 0; lane < lane_count; ++lane) {
        const Vector p = position[first + lane] - origin;
        here.x.set(lane, p.x);
        here.y.set(lane, p.y);
        here.z.set(lane, p.z);
    }
    for (const ImageRun& run : runs) {
        const Image& image = list.images()[static_cast<std::size_t>(run.image)];
        for (Index j = run.first; j < run.first + run.count; ++j)
            visit(j, image, here - broadcast(real(image.place(position[j]) - origin)));
    }
}

/// Memory that passes share, one after another. Grows to the widest pass and stays.
std::byte* pass_memory(std::size_t bytes);
std::size_t pass_memory_bytes();
/// Gives it back; the next pass takes what it needs.
void release_pass_memory();

/// The particles of a cluster and the kernel: makes a Pair of an offset to a neighbour.
template <class Kernel> struct PairMaker
{
    const Kernel& kernel;
    double tiny; ///< added to squares, so that none is zero, m²

    Pair operator()(const VectorLanes& offset) const
    {
        Pair pair;
        pair.offset = offset;
        pair.square = dot(offset, offset) + tiny;
        const auto w = kernel.of_square(pair.square);
        pair.kernel = w.value;
        pair.gradient_over_r = w.gradient_over_r;
        return pair;
    }
};

/// Terms, with what they know of a cluster of particles i.
template <class... Terms> struct TermsOfCluster
{
    using Sums = std::tuple<typename Terms::Sum...>;
    using Fars = std::tuple<decltype(far_of(std::declval<const Terms&>(), Index{}))...>;

    const std::tuple<const Terms&...>& terms;
    std::tuple<typename Terms::Near...> near;

    TermsOfCluster(const std::tuple<const Terms&...>& all, Index first)
        : terms(all), near(std::apply([&](const Terms&... each) { return std::tuple{each.near(first)...}; }, all))
    {}

    bool all_ignore(const Fars& far) const { return all_ignore(far, std::index_sequence_for<Terms...>{}); }
    void add(const Fars& far, const Pair& pair, Sums& sums) const
    {
        add(far, pair, sums, std::index_sequence_for<Terms...>{});
    }
    void store(const Cluster& cluster, const Sums& sums) const
    {
        store(cluster, sums, std::index_sequence_for<Terms...>{});
    }

private:
    template <std::size_t... t> bool all_ignore(const Fars& far, std::index_sequence<t...>) const
    {
        return (ignores(std::get<t>(terms), std::get<t>(far)) && ...);
    }
    template <std::size_t... t> void add(const Fars& far, const Pair& pair, Sums& sums, std::index_sequence<t...>) const
    {
        ((ignores(std::get<t>(terms), std::get<t>(far))
              ? void()
              : std::get<t>(terms).add(std::get<t>(near), std::get<t>(far), pair, std::get<t>(sums))),
         ...);
    }
    template <std::size_t... t> void store(const Cluster& cluster, const Sums& sums, std::index_sequence<t...>) const
    {
        (std::get<t>(terms).store(cluster, std::get<t>(near), std::get<t>(sums)), ...);
    }
};

/// The sums over the neighbours that are listed; neighbour(j) gives a neighbour's record. All that it calls is compiled
/// into it, so that sums stay in registers while neighbours pass by.
template <class Kernel, class NeighbourOf, class... Terms>
[[gnu::flatten]] typename TermsOfCluster<Terms...>::Sums
sum_over_runs(std::span<const Run> runs, const PlaceLanes& here, const PairMaker<Kernel>& pair_at,
              const TermsOfCluster<Terms...>& terms, const NeighbourOf& neighbour)
{
    // Not what is returned itself, which would be kept in memory.
    typename TermsOfCluster<Terms...>::Sums sums{};
    if constexpr ((Ignores<Terms> && ...)) {
        for (const Run& run : runs)
            for (Index j = run.first; j < run.first + run.count; ++j) {
                const auto& other = neighbour(j);
                if (!terms.all_ignore(other.far))
                    terms.add(other.far, pair_at(offset_between(here, other.place)), sums);
            }
    }
    else if (RunWalk walk(runs); walk.goes_on()) {
        // One neighbour ahead: what a kernel takes longest for is under way while sums are added to.
        Index j = walk.place();
        Pair pair = pair_at(offset_between(here, neighbour(j).place));
        do {
            walk.advance();
            const Index next = walk.place();
            const Pair next_pair = pair_at(offset_between(here, neighbour(next).place));
            terms.add(neighbour(j).far, pair, sums);
            pair = next_pair;
            j = next;
        } while (walk.goes_on());
    }
    return typename TermsOfCluster<Terms...>::Sums(std::as_const(sums));
}

/// Adds what a cluster sees beyond periodic and symmetry sides.
template <class Kernel, class... Terms>
[[gnu::noinline]] void add_images(const NeighbourList& list, Index c, const VectorField& position,
                                  const PairMaker<Kernel>& pair_at, const TermsOfCluster<Terms...>& terms,
                                  typename TermsOfCluster<Terms...>::Sums& sums)
{
    for_each_image(
        list, list.image_runs(c), position, list.cluster(c).first,
        [&](Index j, const Image& image, const VectorLanes& offset) {
            auto far = std::apply(
                [&](const Terms&... each) { return typename TermsOfCluster<Terms...>::Fars{far_of(each, j)...}; },
                terms.terms);
            if (image.mirrors()) std::apply([&](auto&... f) { ((f = mirrored(f, image.sign)), ...); }, far);
            terms.add(far, pair_at(offset), sums);
        });
}

/// Sums over neighbours, several of them in one pass. A term is a struct with
///
///   struct Near                              what a term needs of particle i (a cluster of them, in lanes)
///   struct Far                               what it needs of particle j
///   struct Sum                               what it adds up, zero to begin with
///   Near near(Index first) const             loads it
///   Far far(Index j) const                   the same for a neighbour
///   bool idle(Cluster) const                 true where the term has nothing to do for this cluster
///   bool ignores(const Far&) const           if there is one: true for a neighbour that adds nothing to the sum
///   void add(const Near&, const Far&, const Pair&, Sum&) const      the formula
///   void store(Cluster, const Near&, const Sum&) const              keeps the sum
///
/// Far may be left out: then add() gets the place j (and must not ask for a vector there, which an image beyond a
/// symmetry side would have to turn). The particle itself is among its neighbours (distance zero,
/// gradient zero, W = W(0)). Each sum is added up by one thread in the order of the list, so the result does not depend
/// on the number of threads.
///
/// Where most clusters take part, what neighbours are asked for is gathered once for the whole pass; where few do, it
/// is looked up as they meet it. In double the numbers are the same, in float to its round-off.
template <class Kernel, class... Terms>
void for_each_pair(const NeighbourList& list, const Particles& particles, const Kernel& kernel,
                   std::span<const Index> clusters, const Terms&... terms)
{
    using Record = Neighbour<Terms...>;
    const auto count = static_cast<Index>(clusters.size());
    const PairMaker<Kernel> pair_at{kernel, 1e-18 * list.support() * list.support()};
    const Places places(list, particles.position);
    const std::tuple<const Terms&...> all_terms{terms...};
    const auto sum_up = [&](const auto& neighbour) {
        // A few clusters are done sooner than threads are woken.
        const Index share = count > 512 ? 16 : 4;
#pragma omp parallel if (count > 16)
        {
            const FlushedToZero no_denormals;
#pragma omp for schedule(dynamic, share)
            for (Index k = 0; k < count; ++k) {
                const Index c = clusters[static_cast<std::size_t>(k)];
                const Cluster cluster = list.cluster(c);
                if (list.skips_idle() && (terms.idle(cluster) && ...)) continue;
                const TermsOfCluster<Terms...> of_cluster(all_terms, cluster.first);
                auto sums =
                    sum_over_runs(list.runs(c), places.of_cluster(cluster.first), pair_at, of_cluster, neighbour);
                if (!list.image_runs(c).empty()) add_images(list, c, particles.position, pair_at, of_cluster, sums);
                of_cluster.store(cluster, sums);
            }
        }
    };

    if (2 * count < list.cluster_count()) {
        sum_up([&](Index j) { return Record{places(j), {far_of(terms, j)...}}; });
        return;
    }
    const Index all = particles.count();
    auto* records = reinterpret_cast<Record*>(pass_memory(static_cast<std::size_t>(all) * sizeof(Record)));
#pragma omp parallel for schedule(static)
    for (Index j = 0; j < all; ++j)
        new (records + j) Record{places(j), {far_of(terms, j)...}};
    sum_up([records](Index j) -> const Record& { return records[j]; });
}

/// Sum of value(i) over all particles, of a number or of anything that adds up, in blocks of fixed size so that the
/// number of threads does not matter.
template <class Value> auto ordered_sum(Index count, const Value& value)
{
    using Sum = decltype(value(Index{}));
    constexpr Index block = 4096;
    const Index blocks = (count + block - 1) / block;
    std::vector<Sum> partial(static_cast<std::size_t>(blocks), Sum{});
#pragma omp parallel for schedule(static) if (blocks > 1)
    for (Index b = 0; b < blocks; ++b) {
        const Index end = std::min(count, (b + 1) * block);
        Sum sum{};
        for (Index i = b * block; i < end; ++i)
            sum += value(i);
        partial[static_cast<std::size_t>(b)] = sum;
    }
    Sum total{};
    for (const Sum& sum : partial)
        total += sum;
    return total;
}

} // namespace cupel::inline CUPEL_ENGINE
