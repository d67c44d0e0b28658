#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#include "math/vector.hpp"

namespace cupel
{

using Index = std::int32_t;

/// Eight particles side by side: the register that a cluster's sums live in while its neighbours pass by.
/// A GCC/Clang vector type, so that one source compiles to AVX-512, to AVX2 and to the portable path.
inline constexpr int lane_count = 8;
using Lanes = double __attribute__((vector_size(lane_count * sizeof(double))));
using LaneMask = std::int64_t __attribute__((vector_size(lane_count * sizeof(double))));

inline Lanes all_lanes(double value)
{
    return value - Lanes{};
}

/// Eight consecutive values; arrays keep lane_count values beyond their end readable.
inline Lanes load_lanes(const double* values)
{
    Lanes lanes;
    std::memcpy(&lanes, values, sizeof lanes);
    return lanes;
}

/// Writes the first `count` lanes only: what follows belongs to the next cluster.
inline void store_lanes(double* values, const Lanes& lanes, int count)
{
    std::memcpy(values, &lanes, static_cast<std::size_t>(count) * sizeof(double));
}

inline Lanes square_root(const Lanes& a)
{
#if defined(__AVX512F__)
    return reinterpret_cast<Lanes>(_mm512_maskz_sqrt_pd(0xff, reinterpret_cast<__m512d>(a)));
#else
    Lanes result;
    for (int lane = 0; lane < lane_count; ++lane)
        result[lane] = __builtin_sqrt(a[lane]);
    return result;
#endif
}

inline Lanes maximum(const Lanes& a, const Lanes& b)
{
    return a > b ? a : b;
}
inline Lanes minimum(const Lanes& a, const Lanes& b)
{
    return a < b ? a : b;
}

inline bool any(const LaneMask& mask)
{
    std::int64_t found = 0;
    for (int lane = 0; lane < lane_count; ++lane)
        found |= mask[lane];
    return found != 0;
}

using VectorLanes = VectorOf<Lanes>;

inline VectorLanes broadcast(const Vector& a)
{
    return {all_lanes(a.x), all_lanes(a.y), all_lanes(a.z)};
}
inline Symmetric3<Lanes> broadcast(const Symmetric3<double>& m)
{
    return {all_lanes(m.xx), all_lanes(m.xy), all_lanes(m.xz), all_lanes(m.yy), all_lanes(m.yz), all_lanes(m.zz)};
}

} // namespace cupel
