#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "kernels/mirrored.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// What a term needs of a particle (its Near or Far), put together of quantities that have a name: with
///
///   template <class Scalar> struct Velocity { VectorOf<Scalar> velocity; };
///
/// `Of<Real, Velocity, Density>` has the members velocity and density. Terms that share a pass hold a quantity that
/// several of them name once, and what they compute from it is computed once.
template <class Scalar, template <class> class... Quantity> struct Of : Quantity<Scalar>...
{};

/// The quantities that models share. A name stands for the same field in all terms of a pass.
namespace quantity
{

template <class Scalar> struct Liquid
{
    Scalar liquid; ///< 1 for what moves, 0 for walls and solids
};
template <class Scalar> struct Density
{
    Scalar density; ///< ρ, kg/m³
};
template <class Scalar> struct Pressure
{
    Scalar pressure; ///< p, Pa
};
template <class Scalar> struct Temperature
{
    Scalar temperature; ///< T, K
};
template <class Scalar> struct Mass
{
    Scalar mass; ///< m, kg
};
template <class Scalar> struct Velocity
{
    VectorOf<Scalar> velocity; ///< v, m/s
};
template <class Scalar> struct Shift
{
    VectorOf<Scalar> shift; ///< δu, m/s
};

} // namespace quantity

/// The parts of all terms' Near or Far, none of them twice.
namespace shared_parts
{

template <class... Parts> struct List
{};

/// A plain struct is the term's own, the t-th in the pass; another term of the same kind has another one.
template <std::size_t t, class T> struct Own
{
    [[no_unique_address]] T own; // of nothing, no byte of a record
};

template <std::size_t t, class T> struct PartsOf
{
    using Parts = List<Own<t, T>>;
    static const T& view(const auto& all) { return static_cast<const Own<t, T>&>(all).own; }
    static void put(auto& all, const T& values) { static_cast<Own<t, T>&>(all).own = values; }
};
template <std::size_t t, class Scalar, template <class> class... Quantity> struct PartsOf<t, Of<Scalar, Quantity...>>
{
    using Whole = Of<Scalar, Quantity...>;
    using Parts = List<Quantity<Scalar>...>;
    static Whole view(const auto& all) { return Whole{static_cast<const Quantity<Scalar>&>(all)...}; }
    static void put(auto& all, const Whole& values)
    {
        ((static_cast<Quantity<Scalar>&>(all) = static_cast<const Quantity<Scalar>&>(values)), ...);
    }
};

template <class Done, class... Lists> struct Union;
template <class... Done> struct Union<List<Done...>>
{
    struct All : Done...
    {};
    static void turn(All& all, const Vector& sign)
    {
        ((static_cast<Done&>(all) = mirrored(static_cast<const Done&>(all), sign)), ...);
    }
};
template <class... Done, class... Lists> struct Union<List<Done...>, List<>, Lists...> : Union<List<Done...>, Lists...>
{};
template <class... Done, class First, class... Rest, class... Lists>
struct Union<List<Done...>, List<First, Rest...>, Lists...>
    : Union<std::conditional_t<(std::is_same_v<Done, First> || ...), List<Done...>, List<Done..., First>>,
            List<Rest...>, Lists...>
{};

template <class Indices, class... Wholes> struct SharedAt;
template <std::size_t... t, class... Wholes> struct SharedAt<std::index_sequence<t...>, Wholes...>
{
    using Merged = Union<List<>, typename PartsOf<t, Wholes>::Parts...>;
    using All = typename Merged::All;

    All all;

    SharedAt() = default;
    explicit SharedAt(const Wholes&... wholes) { (PartsOf<t, Wholes>::put(all, wholes), ...); }
    /// What the k-th term needs.
    template <std::size_t k> decltype(auto) of() const
    {
        return PartsOf<k, std::tuple_element_t<k, std::tuple<Wholes...>>>::view(all);
    }
    /// As a mirror shows it.
    void turn(const Vector& sign) { Merged::turn(all, sign); }
};

} // namespace shared_parts

/// What several terms need of a particle, held once.
template <class... Wholes> using Shared = shared_parts::SharedAt<std::index_sequence_for<Wholes...>, Wholes...>;

} // namespace cupel::inline CUPEL_ENGINE
