#pragma once

#include <concepts>
#include <type_traits>

#include "math/lanes.hpp"
#include "math/vector.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// What a term needs of a neighbour (its Far), as a mirror shows it: vectors turn by the signs, numbers stay. A Far is
/// a plain struct of up to eight of them; one that holds a tensor's rows has a `Far mirrored(const Vector& sign) const`
/// of its own.
template <class Far> Far mirrored(Far far, const Vector& sign);

namespace mirrored_members
{

struct Anything
{
    template <class T> operator T() const;
};
template <class T, std::size_t... k> constexpr bool takes(std::index_sequence<k...>)
{
    return requires
    {
        T{((void)k, Anything{})...};
    };
}
template <class T, std::size_t count = 8> constexpr std::size_t member_count()
{
    if constexpr (count == 0 || takes<T>(std::make_index_sequence<count>{}))
        return count;
    else
        return member_count<T, count - 1>();
}

template <class... Members> void turn(const Vector& sign, Members&... members)
{
    ((members = mirrored(members, sign)), ...);
}

} // namespace mirrored_members

template <class Far> Far mirrored(Far far, const Vector& sign)
{
    if constexpr (std::is_arithmetic_v<Far> || std::is_empty_v<Far>)
        return far;
    else if constexpr (std::same_as<Far, VectorOf<Real>>)
        return {static_cast<Real>(sign.x) * far.x, static_cast<Real>(sign.y) * far.y,
                static_cast<Real>(sign.z) * far.z};
    else if constexpr (requires { far.mirrored(sign); })
        return far.mirrored(sign);
    else {
        using mirrored_members::turn;
        constexpr std::size_t count = mirrored_members::member_count<Far>();
        static_assert(count > 0, "a Far has members");
        if constexpr (count == 1) {
            auto& [a] = far;
            turn(sign, a);
        }
        else if constexpr (count == 2) {
            auto& [a, b] = far;
            turn(sign, a, b);
        }
        else if constexpr (count == 3) {
            auto& [a, b, c] = far;
            turn(sign, a, b, c);
        }
        else if constexpr (count == 4) {
            auto& [a, b, c, d] = far;
            turn(sign, a, b, c, d);
        }
        else if constexpr (count == 5) {
            auto& [a, b, c, d, e] = far;
            turn(sign, a, b, c, d, e);
        }
        else if constexpr (count == 6) {
            auto& [a, b, c, d, e, f] = far;
            turn(sign, a, b, c, d, e, f);
        }
        else if constexpr (count == 7) {
            auto& [a, b, c, d, e, f, g] = far;
            turn(sign, a, b, c, d, e, f, g);
        }
        else {
            auto& [a, b, c, d, e, f, g, h] = far;
            turn(sign, a, b, c, d, e, f, g, h);
        }
        return far;
    }
}

} // namespace cupel::inline CUPEL_ENGINE
