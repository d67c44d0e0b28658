#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#if defined(__SSE__)
#include <immintrin.h>
#endif

#include "math/vector.hpp"

/// The engine is compiled once for each instruction set and precision, each time into a namespace of its own, so that
/// one program carries them all and takes the best one that the machine has (programs/engines.hpp). What depends on
/// Lanes is written in `namespace cupel::inline CUPEL_ENGINE`; everything else is compiled once.
#if !defined(CUPEL_ENGINE)
#define CUPEL_ENGINE native_double
#endif
#if !defined(CUPEL_REAL)
#define CUPEL_REAL double
#endif

namespace cupel::inline CUPEL_ENGINE
{

#define CUPEL_QUOTE_NAME(name) #name
#define CUPEL_QUOTE(macro) CUPEL_QUOTE_NAME(macro)
inline constexpr const char* engine_name = CUPEL_QUOTE(CUPEL_ENGINE);

/// Pair arithmetic is done in Real. Fields, positions and everything outside the pair loops are double.
using Real = CUPEL_REAL;

/// A cluster of particles side by side, eight in double or sixteen in float: 64 bytes, the register that a cluster's
/// sums live in while its neighbours pass by.
inline constexpr int lane_count = 64 / sizeof(Real);

struct LaneMask
{
    using Bits = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
    using Register = Bits __attribute__((vector_size(64)));
    Register bits;
};

/// One Real for each particle of a cluster. A GCC/Clang vector within, so that one source compiles to AVX-512, to AVX2
/// and to portable code. A number where lanes are expected stands for all of them.
class Lanes
{
public:
    using Register = Real __attribute__((vector_size(64)));

    Lanes() : values_{} {}
    template <std::floating_point Number> Lanes(Number value) : values_(static_cast<Real>(value) - Register{}) {}
    explicit Lanes(Register values) : values_(values) {}

    Real operator[](int lane) const { return values_[lane]; }
    void set(int lane, double value) { values_[lane] = static_cast<Real>(value); }
    Register values() const { return values_; }

    Lanes& operator+=(const Lanes& b)
    {
        values_ += b.values_;
        return *this;
    }
    Lanes& operator-=(const Lanes& b)
    {
        values_ -= b.values_;
        return *this;
    }
    friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.values_ + b.values_); }
    friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.values_ - b.values_); }
    friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.values_ * b.values_); }
    friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.values_ / b.values_); }
    friend Lanes operator-(const Lanes& a) { return Lanes(-a.values_); }
    friend LaneMask operator<(const Lanes& a, const Lanes& b) { return {a.values_ < b.values_}; }
    friend LaneMask operator>(const Lanes& a, const Lanes& b) { return {a.values_ > b.values_}; }

private:
    Register values_;
};

inline LaneMask operator&(const LaneMask& a, const LaneMask& b)
{
    return {a.bits & b.bits};
}

/// yes where the mask is set, no elsewhere.
inline Lanes select(const LaneMask& mask, const Lanes& yes, const Lanes& no)
{
    return Lanes(mask.bits ? yes.values() : no.values());
}
inline Lanes maximum(const Lanes& a, const Lanes& b)
{
#if defined(__AVX512F__)
    // One instruction, where the compiler, minding zeros' signs, takes two.
    if constexpr (sizeof(Real) == 8)
        return Lanes(reinterpret_cast<Lanes::Register>(
            _mm512_maskz_max_pd(0xff, reinterpret_cast<__m512d>(a.values()), reinterpret_cast<__m512d>(b.values()))));
    else
        return Lanes(reinterpret_cast<Lanes::Register>(
            _mm512_maskz_max_ps(0xffff, reinterpret_cast<__m512>(a.values()), reinterpret_cast<__m512>(b.values()))));
#else
    return select(a > b, a, b);
#endif
}
inline Lanes minimum(const Lanes& a, const Lanes& b)
{
    return select(a < b, a, b);
}

inline Lanes square_root(const Lanes& a)
{
    Lanes::Register root;
    for (int lane = 0; lane < lane_count; ++lane)
        root[lane] = std::sqrt(a.values()[lane]);
    return Lanes(root);
}

/// 1/√a for a > 0, to the last bit or two. Newton's steps on the machine's estimate are faster than its square root.
inline Lanes reciprocal_square_root(const Lanes& a)
{
#if defined(__AVX512F__)
    // The estimate has 14 bits; a step doubles them: one for float, two for double.
    if constexpr (sizeof(Real) == 4) {
        const Lanes estimate(
            reinterpret_cast<Lanes::Register>(_mm512_maskz_rsqrt14_ps(0xffff, reinterpret_cast<__m512>(a.values()))));
        return estimate * (1.5 - (0.5 * a) * estimate * estimate);
    }
    else {
        Lanes estimate(
            reinterpret_cast<Lanes::Register>(_mm512_maskz_rsqrt14_pd(0xff, reinterpret_cast<__m512d>(a.values()))));
        const Lanes half = 0.5 * a;
        estimate = estimate * (1.5 - half * estimate * estimate);
        return estimate * (1.5 - half * estimate * estimate);
    }
#else
    return 1.0 / square_root(a);
#endif
}
/// One bit for each lane, the first lowest.
inline unsigned set_lanes(const LaneMask& mask)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    if constexpr (sizeof(Real) == 8)
        return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask.bits));
    else
        return _mm512_movepi32_mask(reinterpret_cast<__m512i>(mask.bits));
#else
    unsigned bits = 0;
    for (int lane = 0; lane < lane_count; ++lane)
        bits |= mask.bits[lane] != 0 ? 1u << lane : 0u;
    return bits;
#endif
}

/// Consecutive values; arrays keep 16 values beyond their end readable.
inline Lanes load_lanes(const double* values)
{
    Lanes::Register lanes;
    if constexpr (sizeof(Real) == 8)
        std::memcpy(&lanes, values, sizeof lanes);
    else
        for (int lane = 0; lane < lane_count; ++lane)
            lanes[lane] = static_cast<Real>(values[lane]);
    return Lanes(lanes);
}

/// Writes the first `count` lanes only: what follows belongs to the next cluster.
inline void store_lanes(double* values, const Lanes& lanes, int count)
{
    for (int lane = 0; lane < count; ++lane)
        values[lane] = lanes[lane];
}

using VectorLanes = VectorOf<Lanes>;

template <std::floating_point Number> VectorLanes broadcast(const VectorOf<Number>& a)
{
    return {a.x, a.y, a.z};
}
} // namespace cupel::inline CUPEL_ENGINE
