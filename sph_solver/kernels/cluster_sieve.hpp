#pragma once

#include <bit>
#include <numeric>
#include <span>
#include <vector>

#include "kernels/neighbour_list.hpp"

/// What a neighbour list is made with: a whole cluster of candidates against a limit at once, and runs from what is
/// left.
namespace cupel::inline CUPEL_ENGINE
{

/// A cluster's coordinates in float, in either precision: lists have a margin for what that leaves out.
using Narrow = float __attribute__((vector_size(4 * lane_count)));

inline Narrow narrow(const Array& coordinate, Index first, double middle)
{
    Narrow lanes;
    const double* values = coordinate.data() + first;
    for (int lane = 0; lane < lane_count; ++lane)
        lanes[lane] = static_cast<float>(values[lane] - middle);
    return lanes;
}
#if defined(__AVX512F__) && CUPEL_REAL_IS_FLOAT
// By name, where the compiler, minding what is no number, would take several instructions for one.
inline Narrow lesser(const Narrow& a, const Narrow& b)
{
    return reinterpret_cast<Narrow>(
        _mm512_maskz_min_ps(0xffff, reinterpret_cast<__m512>(a), reinterpret_cast<__m512>(b)));
}
inline unsigned lanes_below(const Narrow& a, float limit)
{
    return _mm512_cmp_ps_mask(reinterpret_cast<__m512>(a), _mm512_set1_ps(limit), _CMP_LT_OQ);
}
#elif defined(__AVX__) && !CUPEL_REAL_IS_FLOAT
inline Narrow lesser(const Narrow& a, const Narrow& b)
{
    return reinterpret_cast<Narrow>(_mm256_min_ps(reinterpret_cast<__m256>(a), reinterpret_cast<__m256>(b)));
}
inline unsigned lanes_below(const Narrow& a, float limit)
{
    return static_cast<unsigned>(
        _mm256_movemask_ps(_mm256_cmp_ps(reinterpret_cast<__m256>(a), _mm256_set1_ps(limit), _CMP_LT_OQ)));
}
#else
inline Narrow lesser(const Narrow& a, const Narrow& b)
{
    return a < b ? a : b;
}
/// One bit for each lane below a limit, the first lowest.
inline unsigned lanes_below(const Narrow& a, float limit)
{
    unsigned bits = 0;
    for (int lane = 0; lane < lane_count; ++lane)
        bits |= static_cast<unsigned>(a[lane] < limit) << lane;
    return bits;
}
#endif

inline Index neighbours_in(std::span<const Run> runs)
{
    return std::accumulate(runs.begin(), runs.end(), Index{0},
                           [](Index sum, const Run& run) { return sum + run.count; });
}

/// Appends first + bit for each bit that is set, as runs, to a list that may end with the particle before.
inline void append_runs(std::vector<Run>& list, std::size_t begin, Index first, unsigned bits)
{
    while (bits != 0) {
        const int skipped = std::countr_zero(bits);
        bits >>= skipped;
        first += skipped;
        const int count = std::countr_one(bits);
        if (list.size() > begin && list.back().first + list.back().count == first)
            list.back().count += count;
        else
            list.push_back({first, count});
        bits >>= count;
        first += count;
    }
}

} // namespace cupel::inline CUPEL_ENGINE
