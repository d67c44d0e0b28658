#include "math/lanes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cupel
{
namespace
{

constexpr unsigned all = (1u << lane_count) - 1u;

/// value(lane) in each lane.
template <class Value> Lanes lanes_of(const Value& value)
{
    Lanes lanes;
    for (int lane = 0; lane < lane_count; ++lane)
        lanes.set(lane, value(lane));
    return lanes;
}
const Lanes rising = lanes_of([](int lane) { return lane - 2.5; });
const Lanes swinging = lanes_of([](int lane) { return lane % 2 == 0 ? 1.0 + lane : -0.25 * lane; });

TEST(Lanes, ComparisonsTellEachLaneApart)
{
    unsigned below = 0, above = 0;
    for (int lane = 0; lane < lane_count; ++lane) {
        below |= static_cast<unsigned>(rising[lane] < swinging[lane]) << lane;
        above |= static_cast<unsigned>(rising[lane] > swinging[lane]) << lane;
    }
    EXPECT_EQ(set_lanes(rising < swinging), below);
    EXPECT_EQ(set_lanes(rising > swinging), above);
    EXPECT_EQ(set_lanes((rising < swinging) & (rising > 0.0)), below & ~0b111u);
    EXPECT_EQ(set_lanes((rising < swinging) | (rising > swinging)), below | above);
    EXPECT_EQ(set_lanes(rising < std::numeric_limits<double>::infinity()), all);
    EXPECT_EQ(set_lanes(rising < rising), 0u);
    const Lanes nothing(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(set_lanes(nothing < rising), 0u);
    // One lane at a time: none is taken for its neighbour.
    for (int lane = 0; lane < lane_count; ++lane) {
        Lanes one(1.0);
        one.set(lane, -1.0);
        EXPECT_EQ(set_lanes(one < 0.0), 1u << lane);
        EXPECT_TRUE(may_be_below(one, 0.0)) << lane;
    }
}

TEST(Lanes, SelectionAndLimitsAreThoseOfEachLane)
{
    const Lanes chosen = select(rising < swinging, rising, swinging);
    const Lanes least = minimum(rising, swinging), most = maximum(rising, swinging), within = clamp(rising, -1.0, 2.0);
    for (int lane = 0; lane < lane_count; ++lane) {
        EXPECT_EQ(chosen[lane], std::min(rising[lane], swinging[lane]));
        EXPECT_EQ(least[lane], std::min(rising[lane], swinging[lane]));
        EXPECT_EQ(most[lane], std::max(rising[lane], swinging[lane]));
        EXPECT_EQ(within[lane], std::clamp<Real>(rising[lane], -1, 2));
    }
}

TEST(Lanes, ArithmeticIsThatOfEachLane)
{
    const Lanes sum = rising + swinging, difference = rising - swinging, product = rising * swinging,
                quotient = rising / swinging, opposite = -rising;
    const Lanes positive = product * product + 0.5;
    const Lanes root = square_root(positive), close_root = root_of_positive(positive),
                inverse_root = reciprocal_root_of_positive(positive), inverse = reciprocal(positive);
    constexpr Real few = 8 * std::numeric_limits<Real>::epsilon();
    for (int lane = 0; lane < lane_count; ++lane) {
        const Real a = rising[lane], b = swinging[lane], p = positive[lane];
        EXPECT_EQ(sum[lane], a + b);
        EXPECT_EQ(difference[lane], a - b);
        EXPECT_EQ(product[lane], a * b);
        EXPECT_NEAR(quotient[lane], a / b, few * std::abs(a / b));
        EXPECT_EQ(opposite[lane], -a);
        EXPECT_NEAR(root[lane], std::sqrt(p), few * std::sqrt(p));
        EXPECT_NEAR(close_root[lane], std::sqrt(p), few * std::sqrt(p));
        EXPECT_NEAR(inverse_root[lane] * std::sqrt(p), 1, few);
        EXPECT_NEAR(inverse[lane] * p, 1, few);
    }
}

TEST(Lanes, LoadsAndStoresWhatIsAskedFor)
{
    std::array<double, lane_count + 16> values{};
    for (std::size_t k = 0; k < values.size(); ++k)
        values[k] = 0.5 * static_cast<double>(k);
    const Lanes loaded = load_lanes(values.data() + 1);
    for (int lane = 0; lane < lane_count; ++lane)
        EXPECT_EQ(loaded[lane], 0.5 * (lane + 1));
    for (const unsigned which : {0u, 1u, 0b1010u, all & ~1u, all}) {
        std::array<double, lane_count + 1> stored;
        stored.fill(-7.0);
        store_lanes(stored.data(), which, loaded);
        for (int lane = 0; lane < lane_count; ++lane)
            EXPECT_EQ(stored[static_cast<std::size_t>(lane)], which >> lane & 1u ? 0.5 * (lane + 1) : -7.0);
        EXPECT_EQ(stored.back(), -7.0);
    }
}

} // namespace
} // namespace cupel
