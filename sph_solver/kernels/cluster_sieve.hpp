#pragma once

#include "kernels/neighbour_list.hpp"

/// What a neighbour list is made with: a whole cluster of candidates against a limit at once.
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

} // namespace cupel::inline CUPEL_ENGINE
