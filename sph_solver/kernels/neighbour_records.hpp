#pragma once

#include <atomic>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "kernels/field_lanes.hpp"
#include "kernels/neighbour_list.hpp"
#include "kernels/places.hpp"
#include "kernels/terms.hpp"
#include "particles/particles.hpp"

/// What a pass keeps of particles as neighbours, and which of these add to the sums of a cluster.
namespace cupel::inline CUPEL_ENGINE
{

/// What is kept of a particle for the length of a pass: all that the loop and the terms need of a neighbour, side by
/// side in memory.
template <class... Terms> struct Neighbour
{
    Place place;
    Real volume;
    Shared<decltype(far_of(std::declval<const Terms&>(), Index{}))...> far;
};

/// Makes it.
template <class... Terms> struct RecordOf
{
    using Record = Neighbour<Terms...>;
    using Far = decltype(Record::far);

    const Particles& particles;
    const Places& places;
    const std::tuple<const Terms&...>& terms;

    Far far(Index j) const
    {
        return std::apply([&](const Terms&... each) { return Far(far_of(each, j)...); }, terms);
    }
    Record operator()(Index j, const Far& far) const { return {places(j), real(particles.volume[j]), far}; }
};

/// Memory that passes share, one after another. Grows to the widest pass and stays.
std::byte* pass_memory(std::size_t bytes);
std::size_t pass_memory_bytes();
/// Gives it back; the next pass takes what it needs.
void release_pass_memory();

/// Appends the particles that are listed, in order; up to 16 more places may be written to. Returns the new end.
inline Index* append(Index* end, const Listed& some)
{
#if defined(__AVX512F__)
    const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const __m512i all = _mm512_add_epi32(_mm512_set1_epi32(some.first), lane);
    _mm512_storeu_si512(end, _mm512_maskz_compress_epi32(static_cast<__mmask16>(some.lanes), all));
    return end + some.count();
#else
    for (Index lane = 0; lane < Listed::most; ++lane) {
        *end = some.first + lane;
        end += (some.lanes >> lane) & 1u;
    }
    return end;
#endif
}

/// Which particles a pass does not ignore, a bit for each, cluster by cluster: found where it is first asked, since a
/// pass may be near few clusters, and each of those is near many others.
class LanesOfInterest
{
public:
    explicit LanesOfInterest(const NeighbourList& list)
        : list_(list), lanes_(static_cast<std::size_t>(list.cluster_count()), unknown)
    {}

    template <class Ignored> std::uint32_t of(const Listed& some, const Ignored& ignored)
    {
        std::uint32_t lanes = 0;
        list_.for_each_cluster_of(some, [&](Index c, Index k) { lanes |= of_cluster(c, ignored) << k; });
        return some.lanes & lanes;
    }

private:
    template <class Ignored> std::uint32_t of_cluster(Index c, const Ignored& ignored)
    {
        // Threads may find the same bits side by side.
        const std::atomic_ref<std::uint32_t> kept(lanes_[static_cast<std::size_t>(c)]);
        std::uint32_t lanes = kept.load(std::memory_order_relaxed);
        if (lanes != unknown) return lanes;
        const Cluster& cluster = list_.cluster(c);
        lanes = 0;
        for (Index k = 0; k < cluster.count; ++k)
            lanes |= static_cast<std::uint32_t>(!ignored(cluster.first + k)) << k;
        kept.store(lanes, std::memory_order_relaxed);
        return lanes;
    }

    static constexpr std::uint32_t unknown = ~0u;
    const NeighbourList& list_;
    std::vector<std::uint32_t> lanes_;
};

/// The neighbours of one cluster that add to its sums: records, and which of them, in the order of the list.
template <class Record> struct SomeRecords
{
    const Record* records;
    std::span<const Index> which;
};

/// Makes them for cluster after cluster, in memory that each thread keeps.
template <class Record> class NeighboursOfCluster
{
public:
    /// From records of all particles.
    template <class Wanted>
    SomeRecords<Record> find(std::span<const Listed> near, const Record* records, const Wanted& wanted)
    {
        reserve(near);
        Index* end = which_.data();
        for (const Listed& some : near)
            end = append(end, {some.first, wanted(some)});
        return {records, {which_.data(), end}};
    }
    /// Looked up one by one, where a pass concerns too few for a record of each.
    template <class RecordOf, class Wanted>
    SomeRecords<Record> look_up(std::span<const Listed> near, const RecordOf& record_of, const Wanted& wanted)
    {
        reserve(near);
        copies_.resize(which_.size() * sizeof(Record));
        auto* records = reinterpret_cast<Record*>(copies_.data());
        Index count = 0;
        for (const Listed& some : near)
            Listed{some.first, wanted(some)}.for_each(
                [&](Index j) { new (records + count++) Record(record_of(j, record_of.far(j))); });
        std::iota(which_.begin(), which_.begin() + count, Index{0});
        return {records, {which_.data(), static_cast<std::size_t>(count)}};
    }

private:
    /// For as many as there can be: to count them takes a sixth of the time that it takes to write them down.
    void reserve(std::span<const Listed> near)
    {
        const std::size_t most = near.size() * static_cast<std::size_t>(Listed::most) + 32;
        if (which_.size() < most) which_.resize(most);
    }
    std::vector<Index> which_;
    std::vector<std::byte> copies_;
};

} // namespace cupel::inline CUPEL_ENGINE
