#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include <omp.h>

#include "math/vector.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The numbers from 0 to count, divided among the threads of a parallel region. Each thread has a stretch of its own
/// and goes through it from its start; one that is done takes the second half of what another has left. So numbers that
/// follow each other, clusters that are near the same neighbours, are met by one thread, and no thread waits while
/// another has more than a piece to do: not even where one is slower, because its processor has other work.
class Stretches
{
public:
    /// `piece` numbers are taken at a time.
    Stretches(Index count, Index piece)
        : piece_(piece), stretches_(static_cast<std::size_t>(std::max(1, omp_get_max_threads())))
    {
        const auto threads = static_cast<std::int64_t>(stretches_.size());
        for (std::int64_t thread = 0; thread < threads; ++thread)
            stretches_[static_cast<std::size_t>(thread)].left = packed(
                {static_cast<Index>(count * thread / threads), static_cast<Index>(count * (thread + 1) / threads)});
    }

    struct Range
    {
        Index begin, end;
    };
    /// The next numbers for the thread that asks, of a parallel region or alone; false where none are left to take.
    bool next(Range& some)
    {
        const auto mine = static_cast<std::size_t>(omp_get_thread_num()) % stretches_.size();
        do
            some = take(stretches_[mine]);
        while (some.begin >= some.end && take_from_another(mine));
        return some.begin < some.end;
    }
    /// visit(k) for each of them.
    template <class Visit> void for_each(const Visit& visit)
    {
        for (Range some{}; next(some);)
            for (Index k = some.begin; k < some.end; ++k)
                visit(k);
    }

private:
    /// What is left of a stretch, both ends in one number that changes at once; each on a cache line of its own.
    struct alignas(64) Stretch
    {
        std::atomic<std::uint64_t> left{0};
    };
    // Relaxed: whoever finds a range as it was may take of it, whatever has happened meanwhile, and results meet at the
    // end of the region.
    static constexpr auto relaxed = std::memory_order_relaxed;

    static std::uint64_t packed(const Range& range)
    {
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>(range.begin)) << 32 |
               static_cast<std::uint32_t>(range.end);
    }
    static Range unpacked(std::uint64_t left)
    {
        return {static_cast<Index>(left >> 32), static_cast<Index>(left & 0xffffffffU)};
    }

    /// The next piece; an empty one at the end.
    Range take(Stretch& stretch) const
    {
        std::uint64_t seen = stretch.left.load(relaxed);
        while (true) {
            const Range left = unpacked(seen);
            const Index next = std::min(left.end, left.begin + piece_);
            if (left.begin >= left.end) return left;
            if (stretch.left.compare_exchange_weak(seen, packed({next, left.end}), relaxed)) return {left.begin, next};
        }
    }
    /// Fills one's own stretch with half of what is left of another, or with all where that is little.
    bool take_from_another(std::size_t mine)
    {
        for (std::size_t k = 1; k < stretches_.size(); ++k) {
            Stretch& other = stretches_[(mine + k) % stretches_.size()];
            std::uint64_t seen = other.left.load(relaxed);
            for (Range left = unpacked(seen); left.begin < left.end; left = unpacked(seen)) {
                const Index count = left.end - left.begin, middle = count > piece_ ? left.end - count / 2 : left.begin;
                if (!other.left.compare_exchange_weak(seen, packed({left.begin, middle}), relaxed)) continue;
                stretches_[mine].left.store(packed({middle, left.end}), relaxed);
                return true;
            }
        }
        return false;
    }

    Index piece_;
    std::vector<Stretch> stretches_;
};

/// Has all threads do the work, or this one alone where it is worth no more. Nothing at all is asked of the system
/// where there is but one thread.
template <class Work> void by_all_threads(bool worth_it, const Work& work)
{
    if (!worth_it || omp_get_max_threads() == 1) return work();
#pragma omp parallel
    work();
}

} // namespace cupel::inline CUPEL_ENGINE
