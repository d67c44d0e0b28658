#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstring>

#include "math/engine.hpp"
#include "math/registers.hpp"
#include "math/vector.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// A cluster of particles side by side, eight in double or sixteen in float: 64 bytes, the register that a cluster's
/// sums live in while its neighbours pass by.
inline constexpr int lane_count = 64 / sizeof(Real);

/// While it lives, what float cannot hold to its full digits counts as zero in this thread. The outermost neighbours'
/// fourth powers of W are such numbers, and a processor may take a hundred times as long for them.
class FlushedToZero
{
#if defined(__SSE__) && CUPEL_REAL_IS_FLOAT
public:
    FlushedToZero() : before_(_mm_getcsr())
    {
        _mm_setcsr(before_ | 0x8040u);
    }
    ~FlushedToZero()
    {
        _mm_setcsr(before_);
    }
    FlushedToZero(const FlushedToZero&) = delete;
    FlushedToZero& operator=(const FlushedToZero&) = delete;

private:
    unsigned before_;
#else
public:
    FlushedToZero() {}
#endif
};

/// What a comparison of two Lanes says of each.
struct LaneMask
{
    decltype(Packed<Real>{} < Packed<Real>{}) bits;
};

/// One Real for each particle of a cluster, in registers of the machine's width, so that one source compiles to
/// AVX-512, to AVX2 and to portable code. A number where lanes are expected stands for all of them.
class Lanes
{
public:
    using Registers = Packed<Real>;

    Lanes() : values_{} {}
    template <std::floating_point Number> Lanes(Number value) : values_(packed<Registers>(static_cast<Real>(value))) {}
    explicit Lanes(const Registers& values) : values_(values) {}
    explicit Lanes(const std::array<Real, lane_count>& values)
    {
        std::memcpy(static_cast<void*>(&values_), &values, sizeof values_);
    }

    Real operator[](int lane) const { return number_at<Real>(values_, lane); }
    void set(int lane, double value) { set_number_at(values_, lane, static_cast<Real>(value)); }
    const Registers& values() const { return values_; }

    Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
    Lanes& operator-=(const Lanes& b) { return *this = *this - b; }
    friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.values_ + b.values_); }
    friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.values_ - b.values_); }
    friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.values_ * b.values_); }
    friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.values_ / b.values_); }
    friend Lanes operator-(const Lanes& a) { return Lanes(-a.values_); }
    friend LaneMask operator<(const Lanes& a, const Lanes& b) { return {a.values_ < b.values_}; }
    friend LaneMask operator>(const Lanes& a, const Lanes& b) { return b < a; }

private:
    Registers values_;
};

inline LaneMask operator&(const LaneMask& a, const LaneMask& b)
{
    return {a.bits & b.bits};
}
inline LaneMask operator|(const LaneMask& a, const LaneMask& b)
{
    return {a.bits | b.bits};
}

/// yes where the mask is set, no elsewhere.
inline Lanes select(const LaneMask& mask, const Lanes& yes, const Lanes& no)
{
    return Lanes(in_registers([](const auto& which, const auto& a, const auto& b) { return which ? a : b; }, mask.bits,
                              yes.values(), no.values()));
}
#if defined(__AVX512F__)
// Where the compiler, minding the signs of zeros, would take two instructions for one, and for the machine's estimates.
inline __m512d doubles(const Lanes& a)
{
    return reinterpret_cast<__m512d>(a.values());
}
inline __m512 floats(const Lanes& a)
{
    return reinterpret_cast<__m512>(a.values());
}
inline Lanes lanes_in(__m512d a)
{
    return Lanes(reinterpret_cast<Lanes::Registers>(a));
}
inline Lanes lanes_in(__m512 a)
{
    return Lanes(reinterpret_cast<Lanes::Registers>(a));
}
inline Lanes maximum(const Lanes& a, const Lanes& b)
{
    if constexpr (sizeof(Real) == 8)
        return lanes_in(_mm512_maskz_max_pd(0xff, doubles(a), doubles(b)));
    else
        return lanes_in(_mm512_maskz_max_ps(0xffff, floats(a), floats(b)));
}
inline Lanes minimum(const Lanes& a, const Lanes& b)
{
    if constexpr (sizeof(Real) == 8)
        return lanes_in(_mm512_maskz_min_pd(0xff, doubles(a), doubles(b)));
    else
        return lanes_in(_mm512_maskz_min_ps(0xffff, floats(a), floats(b)));
}
#else
inline Lanes maximum(const Lanes& a, const Lanes& b)
{
    return select(a > b, a, b);
}
inline Lanes minimum(const Lanes& a, const Lanes& b)
{
    return select(a < b, a, b);
}
#endif

// The same of one number, for formulas that are asked for either.
inline double select(bool which, double yes, double no)
{
    return which ? yes : no;
}
inline double clamp(double a, double least, double most)
{
    return a < least ? least : most < a ? most : a;
}
inline double square_root(double a)
{
    return std::sqrt(a);
}

inline Lanes clamp(const Lanes& a, double least, double most)
{
    return minimum(maximum(a, Lanes(least)), Lanes(most));
}
inline Lanes square_root(const Lanes& a)
{
    return Lanes(in_registers(
        [](auto root) {
            for (std::size_t k = 0; k < sizeof root / sizeof root[0]; ++k)
                root[k] = std::sqrt(root[k]);
            return root;
        },
        a.values()));
}

#if defined(__AVX512F__)
/// The machine's estimate of 1/√a (14 bits) and what is left to correct: with s = a e and y = 1 − s e,
///
///   1/√a = e (1 − y)^(−½) = e + e c,   √a = s + s c,   c = y/2 + 3/8 y² + 5/16 y³ + …
///
/// One term is enough for float, three for double, and faster than the machine's own square root.
struct RootEstimate
{
    Lanes estimate, product, correction;

    explicit RootEstimate(const Lanes& a)
    {
        if constexpr (sizeof(Real) == 8)
            estimate = lanes_in(_mm512_maskz_rsqrt14_pd(0xff, doubles(a)));
        else
            estimate = lanes_in(_mm512_maskz_rsqrt14_ps(0xffff, floats(a)));
        product = a * estimate;
        const Lanes y = 1.0 - product * estimate;
        correction = sizeof(Real) == 8 ? y * (0.5 + y * (0.375 + 0.3125 * y)) : 0.5 * y;
    }
};
inline Lanes reciprocal_root_of_positive(const Lanes& a)
{
    const RootEstimate root(a);
    return root.estimate + root.estimate * root.correction;
}
inline Lanes root_of_positive(const Lanes& a)
{
    const RootEstimate root(a);
    return root.product + root.product * root.correction;
}
/// 1/a to the last bit or two, a neither zero nor beyond what its reciprocal can hold.
inline Lanes reciprocal(const Lanes& a)
{
    Lanes x;
    if constexpr (sizeof(Real) == 8)
        x = lanes_in(_mm512_maskz_rcp14_pd(0xff, doubles(a)));
    else
        x = lanes_in(_mm512_maskz_rcp14_ps(0xffff, floats(a)));
    const Lanes y = 1.0 - a * x;
    return sizeof(Real) == 8 ? x + x * (y + y * (y * (1.0 + y))) : x + x * y;
}
#else
/// 1/√a, √a and 1/a to the last bit or two, for a > 0.
inline Lanes reciprocal_root_of_positive(const Lanes& a)
{
    return 1.0 / square_root(a);
}
inline Lanes root_of_positive(const Lanes& a)
{
    return square_root(a);
}
inline Lanes reciprocal(const Lanes& a)
{
    return 1.0 / a;
}
#endif

/// One bit for each lane, the first lowest.
inline unsigned set_lanes(const LaneMask& mask)
{
    return bits_of<Real>(mask.bits);
}

/// Whether a lane is below a limit; where the machine has no short way to tell, always.
inline bool may_be_below(const Lanes& a, double limit)
{
#if defined(__AVX512F__)
    if constexpr (sizeof(Real) == 8)
        return _mm512_cmp_pd_mask(doubles(a), _mm512_set1_pd(limit), _CMP_LT_OQ) != 0;
    else
        return _mm512_cmp_ps_mask(floats(a), _mm512_set1_ps(static_cast<float>(limit)), _CMP_LT_OQ) != 0;
#elif defined(__SSE2__)
    return set_lanes(a < Lanes(limit)) != 0;
#else
    static_cast<void>(a), static_cast<void>(limit);
    return true;
#endif
}

/// Consecutive values; arrays keep 16 values beyond their end readable.
[[gnu::always_inline]] inline Lanes load_lanes(const double* values)
{
    std::array<Real, lane_count> lanes;
    for (int lane = 0; lane < lane_count; ++lane)
        lanes[static_cast<std::size_t>(lane)] = static_cast<Real>(values[lane]);
    return Lanes(lanes);
}

/// Writes the lanes whose bits are set in `which` and nothing else.
inline void store_lanes(double* values, unsigned which, const Lanes& lanes)
{
#if defined(__AVX512F__)
    if constexpr (sizeof(Real) == 8) {
        // Without a mask what is stored can be loaded again at once.
        if (which == 0xff) return _mm512_storeu_pd(values, doubles(lanes));
        _mm512_mask_storeu_pd(values, static_cast<__mmask8>(which), doubles(lanes));
    }
    else {
        using Half = float __attribute__((vector_size(32)));
        Half halves[2];
        const Lanes::Registers all = lanes.values();
        std::memcpy(halves, &all, sizeof halves);
        for (const Half& half : halves) {
            using Wide = double __attribute__((vector_size(64)));
            const auto wide = reinterpret_cast<__m512d>(__builtin_convertvector(half, Wide));
            _mm512_mask_storeu_pd(values, static_cast<__mmask8>(which), wide);
            values += 8;
            which >>= 8;
        }
    }
#else
    constexpr unsigned all = (1u << lane_count) - 1u;
    for (int lane = 0; lane < lane_count; ++lane)
        if (which == all || which >> lane & 1u) values[lane] = lanes[lane];
#endif
}

using VectorLanes = VectorOf<Lanes>;

template <std::floating_point Number> VectorLanes broadcast(const VectorOf<Number>& a)
{
    return {a.x, a.y, a.z};
}
} // namespace cupel::inline CUPEL_ENGINE
