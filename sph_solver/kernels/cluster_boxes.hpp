#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "kernels/cluster_sieve.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Boxes around clusters in float, rounded outwards, to be asked sixteen at a time which of them are near another box.
class ClusterBoxes
{
public:
    static constexpr Index at_once = sizeof(Filled) / sizeof(float);

    /// All of them out of reach to begin with.
    void resize(std::size_t count)
    {
        for (auto& axis : lower_)
            axis.assign(count + at_once, infinity);
        for (auto& axis : upper_)
            axis.assign(count + at_once, -infinity);
    }
    /// Corners in m from a common origin.
    void set(Index c, const Vector& lower, const Vector& upper)
    {
        const auto k = static_cast<std::size_t>(c);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower_[axis][k] = rounded_down(component(lower, axis));
            upper_[axis][k] = -rounded_down(-component(upper, axis));
        }
    }
    void put_out_of_reach(Index c)
    {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower_[axis][static_cast<std::size_t>(c)] = infinity;
            upper_[axis][static_cast<std::size_t>(c)] = -infinity;
        }
    }

    /// Of the clusters from `first` to the one before `end`, at most at_once, those that come nearer than √square_limit
    /// to a box: a bit for each.
    unsigned near(Index first, Index end, const Vector& lower, const Vector& upper, float square_limit) const
    {
        Filled square{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Filled below = packed<Filled>(rounded_down(component(lower, axis))) - load(upper_[axis], first),
                         above = load(lower_[axis], first) + packed<Filled>(rounded_down(-component(upper, axis)));
            const Filled gap = greater(greater(below, above), Filled{});
            square = square + gap * gap;
        }
        return lanes_below(square, square_limit) & ((1u << std::min(end - first, at_once)) - 1u);
    }
    std::size_t bytes() const { return 6 * lower_[0].size() * sizeof(float); }

private:
    static constexpr float infinity = std::numeric_limits<float>::infinity();
    static double component(const Vector& a, std::size_t axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }
    static float rounded_down(double value) { return static_cast<float>(value - 1.2e-7 * std::abs(value)); }
    static Filled load(const std::vector<float>& values, Index first)
    {
        Filled lanes;
        std::memcpy(static_cast<void*>(&lanes), values.data() + first, sizeof lanes);
        return lanes;
    }

    std::array<std::vector<float>, 3> lower_, upper_;
};

} // namespace cupel::inline CUPEL_ENGINE
