#include "kernels/stretches.hpp"

#include <atomic>
#include <gtest/gtest.h>
#include <vector>

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

/// How often each number is met, and by whom.
struct Met
{
    std::vector<int> times, by;

    Met(Index count, Index piece, int threads, auto&& delay)
        : times(static_cast<std::size_t>(count), 0), by(static_cast<std::size_t>(count), -1)
    {
        const int before = omp_get_max_threads();
        omp_set_num_threads(threads);
        Stretches stretches(count, piece);
        by_all_threads(true, [&] {
            stretches.for_each([&](Index k) {
                delay(k);
                const std::atomic_ref<int> met(times[static_cast<std::size_t>(k)]);
                ++met;
                by[static_cast<std::size_t>(k)] = omp_get_thread_num();
            });
        });
        omp_set_num_threads(before);
    }
};

} // namespace

TEST(Stretches, EachNumberIsMetOnceWhateverTheirNumberAndTheThreads)
{
    for (const int threads : {1, 2, 3, 8})
        for (const Index count : {0, 1, 2, 7, 16, 17, 1000, 10007})
            for (const Index piece : {1, 8, 16})
                for (const int times : Met(count, piece, threads, [](Index) {}).times)
                    ASSERT_EQ(times, 1) << count << " numbers, " << threads << " threads, pieces of " << piece;
}

TEST(Stretches, OneThreadMeetsThemInOrder)
{
    Index next = 0;
    Met(1000, 16, 1, [&](Index k) { EXPECT_EQ(k, next++); });
    EXPECT_EQ(next, 1000);
}

TEST(Stretches, WhatASlowThreadHasLeftIsTakenByAnother)
{
    constexpr Index count = 1000;
    constexpr Index piece = 16;
    std::atomic<Index> met = 0;
    std::atomic<bool> first_is_met = false;
    const Met all(count, piece, 2, [&](Index k) {
        ++met;
        if (k == 0) first_is_met = true;
        // The second thread begins when the first has begun, whose first number is done when all but those of the same
        // piece are.
        while ((k == count / 2 && !first_is_met) || (k == 0 && met < count - piece + 1))
            ;
    });
    EXPECT_EQ(all.by[0], 0);
    EXPECT_EQ(all.by[count / 2 - 1], 1);
    for (const int times : all.times)
        EXPECT_EQ(times, 1);
}

TEST(Stretches, ThreadsThatAreNotThereLeaveNothingUndone)
{
    const int before = omp_get_max_threads();
    omp_set_num_threads(4);
    Stretches stretches(100, 8);
    std::vector<int> times(100, 0);
    stretches.for_each([&](Index k) { ++times[static_cast<std::size_t>(k)]; });
    omp_set_num_threads(before);
    for (const int one : times)
        EXPECT_EQ(one, 1);
}

} // namespace cupel::inline CUPEL_ENGINE
