#include "output/background_thread.hpp"

#include <future>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

namespace cupel::test
{

TEST(BackgroundThread, DoesItsTasksInTheOrderInWhichTheyWereGiven)
{
    std::vector<int> done;
    {
        BackgroundThread thread;
        for (int k = 0; k < 100; ++k)
            thread.add([&done, k] { done.push_back(k); });
    } // its end waits for all of them
    ASSERT_EQ(done.size(), 100U);
    for (int k = 0; k < 100; ++k)
        EXPECT_EQ(done[static_cast<std::size_t>(k)], k);
}

TEST(BackgroundThread, LetsItsOwnerGoOnUntilTheOwnerWaits)
{
    BackgroundThread thread;
    std::promise<void> gate;
    bool first = false, second = false;
    thread.add([&] {
        gate.get_future().wait();
        first = true;
    });
    thread.add([&] { second = true; });
    thread.check();
    thread.wait_for_fewer_than(3);
    gate.set_value();
    thread.wait_for_fewer_than(2);
    EXPECT_TRUE(first);
    thread.wait();
    EXPECT_TRUE(second);
}

TEST(BackgroundThread, AnswersWithWhatATaskHasThrownFromThenOn)
{
    bool later = false;
    {
        BackgroundThread thread;
        thread.add([] { throw std::runtime_error("no space"); });
        EXPECT_THROW(thread.wait(), std::runtime_error);
        EXPECT_THROW(thread.check(), std::runtime_error);
        EXPECT_THROW(thread.add([&] { later = true; }), std::runtime_error);
        EXPECT_THROW(thread.wait_for_fewer_than(100), std::runtime_error);
    }
    EXPECT_FALSE(later);
}

TEST(BackgroundThread, DropsWhatWasGivenAfterATaskThatThrows)
{
    bool later = false;
    BackgroundThread thread;
    std::promise<void> gate;
    thread.add([&] {
        gate.get_future().wait();
        throw std::runtime_error("no space");
    });
    thread.add([&] { later = true; });
    gate.set_value();
    EXPECT_THROW(thread.wait(), std::runtime_error);
    EXPECT_FALSE(later);
}

} // namespace cupel::test
