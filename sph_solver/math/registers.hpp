#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

#if defined(__SSE__)
#include <immintrin.h>
#endif

#include "math/engine.hpp"

/// 64 bytes of numbers in as many registers as the machine needs for them.
///
/// GCC and Clang let a vector be wider than a register, and then take its sums apart well and its comparisons number by
/// number. So what is wider is put together here of vectors that are not.
namespace cupel::inline CUPEL_ENGINE
{

#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX2__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

/// Copied half by half: GCC 12 copies what has no constructor of its own as bytes, and so by way of memory.
template <class Half> struct Halves
{
    Half low{}, high{};

    Halves() = default;
    [[gnu::always_inline]] Halves(const Half& low_half, const Half& high_half) : low(low_half), high(high_half) {}
    [[gnu::always_inline]] Halves(const Halves& other) : low(other.low), high(other.high) {}
    [[gnu::always_inline]] Halves& operator=(const Halves& other)
    {
        low = other.low;
        high = other.high;
        return *this;
    }
};
template <class Number, int bytes> struct PackedIn
{
    using Type = Halves<typename PackedIn<Number, bytes / 2>::Type>;
};
template <class Number> struct PackedIn<Number, register_bytes>
{
    typedef Number Type __attribute__((vector_size(register_bytes))); // `using` refuses what depends on Number
};
template <class Number> using Packed = typename PackedIn<Number, 64>::Type;

template <class T> inline constexpr bool is_halves = false;
template <class Half> inline constexpr bool is_halves<Halves<Half>> = true;

/// apply(registers…) for what several packs have in the same place, packed again.
template <class Apply, class First, class... Others>
[[gnu::always_inline]] inline auto in_registers(const Apply& apply, const First& first, const Others&... others)
{
    if constexpr (is_halves<First>) {
        const auto low = in_registers(apply, first.low, others.low...);
        const auto high = in_registers(apply, first.high, others.high...);
        return Halves<std::remove_const_t<decltype(low)>>{low, high};
    }
    else
        return apply(first, others...);
}

// What vectors have of themselves, for halves of them.
template <class Half> [[gnu::always_inline]] inline auto operator+(const Halves<Half>& a, const Halves<Half>& b)
{
    return in_registers([](const auto& x, const auto& y) { return x + y; }, a, b);
}
template <class Half> [[gnu::always_inline]] inline auto operator-(const Halves<Half>& a, const Halves<Half>& b)
{
    return in_registers([](const auto& x, const auto& y) { return x - y; }, a, b);
}
template <class Half> [[gnu::always_inline]] inline auto operator*(const Halves<Half>& a, const Halves<Half>& b)
{
    return in_registers([](const auto& x, const auto& y) { return x * y; }, a, b);
}
template <class Half> [[gnu::always_inline]] inline auto operator/(const Halves<Half>& a, const Halves<Half>& b)
{
    return in_registers([](const auto& x, const auto& y) { return x / y; }, a, b);
}
template <class Half> [[gnu::always_inline]] inline auto operator&(const Halves<Half>& a, const Halves<Half>& b)
{
    return in_registers([](const auto& x, const auto& y) { return x & y; }, a, b);
}
template <class Half> [[gnu::always_inline]] inline auto operator|(const Halves<Half>& a, const Halves<Half>& b)
{
    return in_registers([](const auto& x, const auto& y) { return x | y; }, a, b);
}
template <class Half> [[gnu::always_inline]] inline auto operator<(const Halves<Half>& a, const Halves<Half>& b)
{
    return in_registers([](const auto& x, const auto& y) { return x < y; }, a, b);
}
template <class Half> [[gnu::always_inline]] inline auto operator-(const Halves<Half>& a)
{
    return in_registers([](const auto& x) { return -x; }, a);
}

/// All numbers the same.
template <class Pack, class Number> [[gnu::always_inline]] inline Pack packed(Number value)
{
    return in_registers([&](const auto& zero) { return value - zero; }, Pack{});
}

template <class Number, class Pack> Number number_at(const Pack& pack, int place)
{
    Number value;
    std::memcpy(&value, reinterpret_cast<const std::byte*>(&pack) + static_cast<std::size_t>(place) * sizeof value,
                sizeof value);
    return value;
}
template <class Number, class Pack> void set_number_at(Pack& pack, int place, Number value)
{
    std::memcpy(reinterpret_cast<std::byte*>(&pack) + static_cast<std::size_t>(place) * sizeof value, &value,
                sizeof value);
}

/// One bit for each of a comparison's results that is true, the first lowest; of a comparison of Numbers.
template <class Number, class Mask> unsigned bits_of(const Mask& mask)
{
    if constexpr (is_halves<Mask>)
        return bits_of<Number>(mask.low) | bits_of<Number>(mask.high) << sizeof(mask.low) / sizeof(Number);
    else {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
        const auto whole = reinterpret_cast<__m512i>(mask);
        return sizeof(Number) == 8 ? _mm512_movepi64_mask(whole) : _mm512_movepi32_mask(whole);
#elif defined(__AVX2__)
        return static_cast<unsigned>(sizeof(Number) == 8 ? _mm256_movemask_pd(reinterpret_cast<__m256d>(mask))
                                                         : _mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#elif defined(__SSE2__)
        return static_cast<unsigned>(sizeof(Number) == 8 ? _mm_movemask_pd(reinterpret_cast<__m128d>(mask))
                                                         : _mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
        unsigned bits = 0;
        for (std::size_t k = 0; k < sizeof mask / sizeof mask[0]; ++k)
            bits |= mask[k] != 0 ? 1u << k : 0u;
        return bits;
#endif
    }
}

} // namespace cupel::inline CUPEL_ENGINE
