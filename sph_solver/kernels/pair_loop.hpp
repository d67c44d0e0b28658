#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "kernels/neighbour_list.hpp"
#include "kernels/neighbour_records.hpp"
#include "kernels/places.hpp"
#include "kernels/smoothing_kernel.hpp"
#include "kernels/stretches.hpp"
#include "kernels/terms.hpp"
#include "particles/particles.hpp"

namespace cupel::inline CUPEL_ENGINE
{

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

/// The particles of a cluster and the kernel: makes a Pair of an offset to a neighbour.
template <class Kernel> struct PairMaker
{
    typename Kernel::template Formula<Real> kernel;
    double tiny;     ///< added to squares, so that none is zero, m²
    double farthest; ///< square beyond which the kernel is zero, m²

    Lanes square(const VectorLanes& offset) const
    {
        return offset.x * offset.x + (offset.y * offset.y + (offset.z * offset.z + tiny));
    }
    Pair operator()(const VectorLanes& offset, const Real& volume) const
    {
        Pair pair;
        pair.offset = offset;
        pair.square = square(offset);
        const auto w = kernel(pair.square);
        pair.kernel = w.value;
        pair.gradient_over_r = w.gradient_over_r;
        pair.weigh(volume);
        return pair;
    }
};

/// visit(first, end) for groups of terms that follow each other, each of them with no more sums than there are
/// registers for beside what they are made of, and local terms apart from others.
template <std::size_t first, class... Terms, class Visit> void for_each_group(const Visit& visit)
{
    constexpr std::size_t registers = 24;
    constexpr std::size_t end = [] {
        constexpr std::size_t sums[]{sizeof(typename Terms::Sum) / sizeof(Lanes)...};
        constexpr bool local[]{Local<Terms>...};
        std::size_t last = first + 1;
        for (std::size_t total = sums[first];
             last < sizeof...(Terms) && local[last] == local[first] && total + sums[last] <= registers; ++last)
            total += sums[last];
        return last;
    }();
    visit(std::integral_constant<std::size_t, first>{}, std::integral_constant<std::size_t, end>{});
    if constexpr (end < sizeof...(Terms)) for_each_group<end, Terms...>(visit);
}

/// As far as a record from the next cache but one is away; lists of neighbours have places beyond their end.
constexpr int neighbours_ahead = 16;

/// The sums over some neighbours. All that it calls is compiled into it, so that sums stay in registers while
/// neighbours pass by. Distances come first, for a few neighbours together, then kernels, then the terms: each loop is
/// short enough for a processor to have several neighbours under way, what a kernel takes longest for (a root, powers)
/// holds up no sum, and a neighbour that turns out to be beyond the support of all particles of the cluster costs no
/// more than its distance. The terms take offsets anew: to keep them would be three writes more for each neighbour.
template <class Kernel, class... Terms>
[[gnu::flatten]] typename TermsOfCluster<Terms...>::Sums
sum_over(const SomeRecords<Neighbour<Terms...>>& neighbours, const PlaceLanes& at, const PairMaker<Kernel>& pair_at,
         const TermsOfCluster<Terms...>& terms)
{
    // Not what is returned itself, which would be kept in memory.
    typename TermsOfCluster<Terms...>::Sums sums{};
    const auto* const records = neighbours.records;
    const Index* next = neighbours.which.data();
    const Index* const end = next + neighbours.which.size();
    const auto kernel_of = pair_at.kernel; // copies: nothing that is written below can be thought to change them
    const PlaceLanes here = at;
    // An array for each number of a pair: one that no term asks for is left out. Bare registers, which nothing sets.
    constexpr int most = 32;
    Lanes::Registers square[most], kernel[most], gradient_over_r[most];
    Index neighbour[most];
    while (next < end) {
        int count = 0;
        for (const Index* const last = std::min(next + most, end); next < last; ++next) {
            __builtin_prefetch(records + next[neighbours_ahead]);
            const Lanes r2 = pair_at.square(offset_between(here, records[*next].place));
            neighbour[count] = *next;
            square[count] = r2.values();
            count += may_be_below(r2, pair_at.farthest);
        }
        for (int k = 0; k < count; ++k) {
            const auto w = kernel_of(Lanes(square[k]));
            kernel[k] = w.value.values();
            gradient_over_r[k] = w.gradient_over_r.values();
        }
        for_each_group<0, Terms...>([&](auto first_term, auto end_term) {
            constexpr bool locals[]{Local<Terms>...};
            if constexpr (locals[first_term()])
                if (!terms.template any_concerned<first_term(), end_term()>()) return;
            for (int k = 0; k < count; ++k) {
                const auto& other = records[neighbour[k]];
                Pair pair;
                pair.offset = offset_between(here, other.place);
                pair.square = Lanes(square[k]);
                pair.kernel = Lanes(kernel[k]);
                pair.gradient_over_r = Lanes(gradient_over_r[k]);
                pair.weigh(other.volume);
                terms.template add<first_term(), end_term()>(other.far, pair, sums);
            }
        });
    }
    return typename TermsOfCluster<Terms...>::Sums(std::as_const(sums));
}

/// The same for terms of few sums, the first `used` of them, and a kernel without roots: a few neighbours at a time go
/// from distance to sum in registers, and one that is beyond the support like any other. That is fewer operations, and
/// nothing long to wait for.
template <std::size_t used, class... Terms>
[[gnu::flatten]] typename TermsOfCluster<Terms...>::Sums
few_sums_over(const SomeRecords<Neighbour<Terms...>>& neighbours, const PlaceLanes& at,
              const PairMaker<RootFree>& pair_at, const TermsOfCluster<Terms...>& terms)
{
    typename TermsOfCluster<Terms...>::Sums sums{};
    const auto* const records = neighbours.records;
    const auto pair_of = pair_at; // copies, as above
    const PlaceLanes here = at;
    const Index* next = neighbours.which.data();
    constexpr std::size_t at_a_time = 4;
    const auto add = [&]<std::size_t... k>(std::index_sequence<k...>)
    {
        const Pair pairs[]{[&] {
            __builtin_prefetch(records + next[neighbours_ahead + k]);
            const auto& other = records[next[k]];
            return pair_of(offset_between(here, other.place), other.volume);
        }()...};
        (terms.template add<0, used>(records[next[k]].far, pairs[k], sums), ...);
        next += sizeof...(k);
    };
    std::size_t left = neighbours.which.size();
    for (; left >= at_a_time; left -= at_a_time)
        add(std::make_index_sequence<at_a_time>{});
    for (; left > 0; --left)
        add(std::make_index_sequence<1>{});
    return typename TermsOfCluster<Terms...>::Sums(std::as_const(sums));
}

/// Adds what a cluster sees beyond periodic and symmetry sides.
template <class Kernel, class... Terms>
[[gnu::noinline]] void add_images(const NeighbourList& list, Index c, const RecordOf<Terms...>& record,
                                  const PairMaker<Kernel>& pair_at, const TermsOfCluster<Terms...>& terms,
                                  typename TermsOfCluster<Terms...>::Sums& sums)
{
    for_each_image(list, list.image_runs(c), record.particles.position, list.cluster(c).first,
                   [&](Index j, const Image& image, const VectorLanes& offset) {
                       auto far = record.far(j);
                       if (TermsOfCluster<Terms...>::all_ignore(record.terms, far, std::index_sequence_for<Terms...>{}))
                           return;
                       if (image.mirrors()) far.turn(image.sign);
                       terms.add(far, pair_at(offset, real(record.particles.volume[j])), sums);
                   });
}

/// What a pass keeps of particles as neighbours, in memory that passes share: of all that the clusters see, or of all
/// there are where that is about the same. Null where so few see any that each looks them up.
template <class Record, class RecordOf>
const Record* records_for(const NeighbourList& list, std::span<const Index> clusters, Index particles,
                          const RecordOf& record)
{
    const auto count = static_cast<Index>(clusters.size()), all = list.cluster_count();
    if (8 * count < all) return nullptr;
    auto* records = reinterpret_cast<Record*>(pass_memory(static_cast<std::size_t>(particles) * sizeof(Record)));
    const auto keep = [&](Index j) { new (records + j) Record(record(j, record.far(j))); };
    if (2 * count > all) {
#pragma omp parallel for schedule(static)
        for (Index j = 0; j < particles; ++j)
            keep(j);
        return records;
    }
    const std::vector<unsigned char> seen = list.seen_from(clusters);
#pragma omp parallel for schedule(static)
    for (Index c = 0; c < all; ++c)
        if (seen[static_cast<std::size_t>(c)])
            for (Index j = list.cluster(c).first; j < list.cluster(c).first + list.cluster(c).count; ++j)
                keep(j);
    return records;
}

/// Sums over neighbours, several of them in one pass. A term is a struct with
///
///   struct Near                              what a term needs of particle i (a cluster of them, in lanes)
///   struct Far                               what it needs of particle j
///   struct Sum                               what it adds up, zero to begin with
///   Near near(Index first) const             loads it
///   Far far(Index j) const                   the same for a neighbour
///   bool idle(Cluster) const                 true where the term has nothing to do for this cluster
///   static constexpr bool local = true       if there is one: most clusters do without this term; where it is idle its
///                                            sums are left out and nothing is stored
///   bool ignores(const Far&) const           if there is one: true for a neighbour that adds nothing to the sum
///   void add(const Near&, const Far&, const Pair&, Sum&) const      the formula
///   void store(Cluster, const Near&, const Sum&) const              keeps the sum
///   void ahead(Index first) const            if there is one: fetches what near() and store() will ask for
///
/// Near and Far may be put together of quantities that terms share (quantities.hpp), so that add() says `const auto&
/// j`. Far may be left out: then add() gets the place j (and must not ask for a vector there, which an image beyond a
/// symmetry side would have to turn). The particle itself is among its neighbours (distance zero,
/// gradient zero, W = W(0)). Each sum is added up by one thread in the order of the list, so the result does not depend
/// on the number of threads. Where sums are few it is quicker with local terms last.
///
/// What neighbours are asked for is gathered once for the whole pass, or where few clusters take part looked up for
/// each of them. The numbers are the same.
template <class Kernel, class... Terms>
void for_each_pair(const NeighbourList& list, const Particles& particles, const Kernel& kernel,
                   std::span<const Index> clusters, const Terms&... terms)
{
    using Record = Neighbour<Terms...>;
    const auto idle = [&](const Cluster& cluster) { return list.skips_idle() && (terms.idle(cluster) && ...); };
    std::vector<Index> concerned;
    constexpr bool concerns_few = ((Ignores<Terms> || Local<Terms>)&&...);
    if constexpr (concerns_few) {
        std::copy_if(clusters.begin(), clusters.end(), std::back_inserter(concerned),
                     [&](Index c) { return !idle(list.cluster(c)); });
        clusters = concerned;
    }
    const auto count = static_cast<Index>(clusters.size());
    const double support_squared = list.support() * list.support();
    const PairMaker<Kernel> pair_at{kernel.template in<Real>(), 1e-18 * support_squared,
                                    (1.0 + 1e-5) * support_squared};
    const Places places(list, particles.position);
    const std::tuple<const Terms&...> all_terms{terms...};
    const RecordOf<Terms...> record{particles, places, all_terms};
    constexpr bool ignores_some = (Ignores<Terms> && ...);
    std::optional<LanesOfInterest> of_interest;
    if constexpr (ignores_some) of_interest.emplace(list);
    const auto wanted = [&](const Listed& some) -> std::uint32_t {
        if constexpr (ignores_some)
            return of_interest->of(some, [&](Index j) {
                return TermsOfCluster<Terms...>::all_ignore(all_terms, record.far(j),
                                                            std::index_sequence_for<Terms...>{});
            });
        else
            return some.lanes;
    };
    const Record* const records = records_for<Record>(list, clusters, particles.count(), record);
    // As many as registers hold beside a few neighbours: of the widest there are twice as many.
    constexpr std::size_t few = register_bytes == 64 ? 8 : 5;
    constexpr bool few_sums = locals_are_last<Terms...> && (sizeof(typename Terms::Sum) + ...) <= few * sizeof(Lanes);
    constexpr std::size_t all_used = sizeof...(Terms), without_locals = (!Local<Terms> + ... + 0);
    constexpr Index clusters_at_a_time = 16;
    Stretches stretches(count, clusters_at_a_time);
    // A few clusters are done sooner than threads are woken.
    by_all_threads(
        count > clusters_at_a_time, [&]() __attribute__((noinline)) {
            const FlushedToZero no_denormals;
            static thread_local NeighboursOfCluster<Record> neighbours;
            for (Stretches::Range some{}; stretches.next(some);)
                for (Index k = some.begin; k < some.end; ++k) {
                    const Index c = clusters[static_cast<std::size_t>(k)];
                    const Cluster cluster = list.cluster(c);
                    if (k + 1 < some.end) {
                        const Index later = list.cluster(clusters[static_cast<std::size_t>(k + 1)]).first;
                        prefetch(particles.position, later);
                        TermsOfCluster<Terms...>::ahead(all_terms, later);
                    }
                    if (!concerns_few && idle(cluster)) continue;
                    const TermsOfCluster<Terms...> of_cluster(all_terms, cluster);
                    const auto found = records ? neighbours.find(list.near(c), records, wanted)
                                               : neighbours.look_up(list.near(c), record, wanted);
                    const PlaceLanes at = places.of_cluster(cluster.first);
                    auto sums = [&] {
                        if constexpr (few_sums && requires { pair_at.kernel.without_roots(); })
                            if (const auto* formula = pair_at.kernel.without_roots()) {
                                const PairMaker<RootFree> root_free{*formula, pair_at.tiny, pair_at.farthest};
                                if constexpr (without_locals < all_used)
                                    if (!of_cluster.template any_concerned<without_locals, all_used>())
                                        return few_sums_over<without_locals>(found, at, root_free, of_cluster);
                                return few_sums_over<all_used>(found, at, root_free, of_cluster);
                            }
                        return sum_over(found, at, pair_at, of_cluster);
                    }();
                    if (!list.image_runs(c).empty()) add_images(list, c, record, pair_at, of_cluster, sums);
                    of_cluster.store(cluster, sums);
                }
        });
}

/// Sum of value(i) over all particles, of a number or of anything that adds up, in blocks of fixed size so that the
/// number of threads does not matter.
template <class Value> auto ordered_sum(Index count, const Value& value)
{
    using Sum = decltype(value(Index{}));
    constexpr Index block = 4096;
    const Index blocks = (count + block - 1) / block;
    const auto sum_of_block = [&](Index b) {
        const Index end = std::min(count, (b + 1) * block);
        Sum sum{};
        for (Index i = b * block; i < end; ++i)
            sum += value(i);
        return sum;
    };
    Sum total{};
    if (blocks == 1) return total += sum_of_block(0);
    std::vector<Sum> partial(static_cast<std::size_t>(blocks), Sum{});
#pragma omp parallel for schedule(static)
    for (Index b = 0; b < blocks; ++b)
        partial[static_cast<std::size_t>(b)] = sum_of_block(b);
    for (const Sum& sum : partial)
        total += sum;
    return total;
}

} // namespace cupel::inline CUPEL_ENGINE
