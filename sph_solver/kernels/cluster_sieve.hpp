#pragma once

#include <array>
#include <cstring>

#include "math/lanes.hpp"
#include "particles/particles.hpp"

/// What a neighbour list is made with: a whole cluster of candidates against a limit at once.
namespace cupel::inline CUPEL_ENGINE
{

/// A cluster's coordinates in float, in either precision: lists have a margin for what that leaves out.
using Narrow = std::array<float, lane_count>;

/// What fills a register of 64 bytes: in double a cluster of candidates twice, in float once, so that it meets as many
/// particles at a time.
using Filled = Packed<float>;
constexpr int particles_at_a_time = 16 / lane_count;

inline Filled filled(const Narrow& a)
{
    Filled all;
    for (int half = 0; half < particles_at_a_time; ++half)
        std::memcpy(reinterpret_cast<std::byte*>(&all) + static_cast<std::size_t>(half) * sizeof a, &a, sizeof a);
    return all;
}

inline Narrow narrow(const Array& coordinate, Index first, double middle)
{
    Narrow lanes;
    const double* values = coordinate.data() + first;
    for (int lane = 0; lane < lane_count; ++lane)
        lanes[static_cast<std::size_t>(lane)] = static_cast<float>(values[lane] - middle);
    return lanes;
}
#if defined(__AVX512F__)
// By name, where the compiler, minding what is no number, would take several instructions for one.
inline Filled lesser(const Filled& a, const Filled& b)
{
    return reinterpret_cast<Filled>(
        _mm512_maskz_min_ps(0xffff, reinterpret_cast<__m512>(a), reinterpret_cast<__m512>(b)));
}
inline Filled greater(const Filled& a, const Filled& b)
{
    return reinterpret_cast<Filled>(
        _mm512_maskz_max_ps(0xffff, reinterpret_cast<__m512>(a), reinterpret_cast<__m512>(b)));
}
inline unsigned lanes_below(const Filled& a, float limit)
{
    return _mm512_cmp_ps_mask(reinterpret_cast<__m512>(a), _mm512_set1_ps(limit), _CMP_LT_OQ);
}
#else
inline Filled lesser(const Filled& a, const Filled& b)
{
    return in_registers([](const auto& x, const auto& y) { return x < y ? x : y; }, a, b);
}
inline Filled greater(const Filled& a, const Filled& b)
{
    return in_registers([](const auto& x, const auto& y) { return x > y ? x : y; }, a, b);
}
/// One bit for each lane below a limit, the first lowest.
inline unsigned lanes_below(const Filled& a, float limit)
{
    return bits_of<float>(in_registers([&](const auto& x) { return x < limit; }, a));
}
#endif
/// The same of a cluster of candidates, wherever in the register it is below.
inline unsigned candidates_below(const Filled& a, float limit)
{
    const unsigned bits = lanes_below(a, limit);
    return particles_at_a_time == 1 ? bits : (bits | bits >> lane_count) & ((1u << lane_count) - 1u);
}

} // namespace cupel::inline CUPEL_ENGINE
