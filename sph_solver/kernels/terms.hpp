#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <tuple>
#include <utility>

#include "kernels/neighbour_list.hpp"
#include "kernels/quantities.hpp"
#include "particles/particles.hpp"

/// Terms as the pair loop sees them: what they share of a pair, and several of them as one.
namespace cupel::inline CUPEL_ENGINE
{

/// What the loop knows of a pair (i, j), for a cluster of particles i at once.
struct Pair
{
    VectorLanes offset;    ///< x_i − x_j, m
    Lanes square;          ///< |x_i − x_j|², m²; never zero
    Lanes kernel;          ///< W_ij
    Lanes gradient_over_r; ///< (1/r) dW/dr, so that ∇_i W_ij = gradient_over_r · offset

    // The same weighted with the neighbour's volume, once for all terms that ask for it.
    Lanes volume_kernel;          ///< V_j W_ij
    Lanes volume_gradient_over_r; ///< V_j (1/r) dW/dr
    VectorLanes volume_gradient;  ///< V_j ∇_i W_ij

    void weigh(const Real& volume)
    {
        volume_kernel = volume * kernel;
        volume_gradient_over_r = volume * gradient_over_r;
        volume_gradient = volume_gradient_over_r * offset;
    }
};

/// The Far of a term that needs no more of a neighbour than the pair.
struct Nothing
{};

/// A term that says what it needs of a neighbour, `Far far(Index j) const`, gets that; any other gets its place j and
/// looks into the fields itself.
template <class Term>
concept HasFar = requires(const Term& term, Index j)
{
    term.far(j);
};

/// A term that takes nothing from some neighbours, most of them perhaps, says so of one: `bool ignores(Far) const`.
template <class Term>
concept Ignores = HasFar<Term> && requires(const Term& term, Index j)
{
    term.ignores(term.far(j));
};

template <class Term> bool ignores(const Term& term, [[maybe_unused]] const auto& far)
{
    if constexpr (Ignores<Term>)
        return term.ignores(far);
    else
        return false;
}

/// A term that concerns few of a pass's clusters, those near a surface perhaps, says so: `static constexpr bool local =
/// true`. Where it is idle its sums are left out and nothing is stored, whatever else the pass finds there.
template <class Term>
concept Local = requires
{
    requires Term::local;
};

template <class... Terms>
inline constexpr bool locals_are_last = [] {
    const bool local[]{Local<Terms>...};
    return std::is_sorted(std::begin(local), std::end(local));
}();

template <class Term> auto far_of(const Term& term, Index j)
{
    if constexpr (HasFar<Term>)
        return term.far(j);
    else
        return j;
}

/// Terms, with what they know of a cluster of particles i.
template <class... Terms> struct TermsOfCluster
{
    using Sums = std::tuple<typename Terms::Sum...>;
    using Fars = Shared<decltype(far_of(std::declval<const Terms&>(), Index{}))...>;

    const std::tuple<const Terms&...>& terms;
    Shared<typename Terms::Near...> near;
    std::array<bool, sizeof...(Terms)> concerned; ///< whether a term has work here

    TermsOfCluster(const std::tuple<const Terms&...>& all, const Cluster& cluster)
        : terms(all),
          near(std::apply(
              [&](const Terms&... each) { return Shared<typename Terms::Near...>(each.near(cluster.first)...); }, all)),
          concerned(std::apply(
              [&](const Terms&... each) {
                  return std::array<bool, sizeof...(Terms)>{(!Local<Terms> || !each.idle(cluster))...};
              },
              all))
    {}

    template <std::size_t... t>
    static bool all_ignore(const std::tuple<const Terms&...>& all, const Fars& far, std::index_sequence<t...>)
    {
        return (ignores(std::get<t>(all), far.template of<t>()) && ...);
    }
    /// Terms from the first to the one before the end.
    template <std::size_t first = 0, std::size_t end = sizeof...(Terms)>
    void add(const Fars& far, const Pair& pair, Sums& sums) const
    {
        add_from<first>(far, pair, sums, std::make_index_sequence<end - first>{});
    }
    /// Whether any of them has work here.
    template <std::size_t first, std::size_t end> bool any_concerned() const
    {
        return std::any_of(concerned.begin() + first, concerned.begin() + end, [](bool one) { return one; });
    }
    /// Fetches what near() and store() of a later cluster will ask for, where a term says what.
    static void ahead(const std::tuple<const Terms&...>& all, Index first)
    {
        const auto of = [&](const auto& term) {
            if constexpr (requires { term.ahead(first); }) term.ahead(first);
        };
        std::apply([&](const Terms&... each) { (of(each), ...); }, all);
    }
    void store(const Cluster& cluster, const Sums& sums) const
    {
        store(cluster, sums, std::index_sequence_for<Terms...>{});
    }

private:
    template <std::size_t first, std::size_t... k>
    void add_from(const Fars& far, const Pair& pair, Sums& sums, std::index_sequence<k...>) const
    {
        (add_one<first + k>(far, pair, sums), ...);
    }
    template <std::size_t t> void add_one(const Fars& far, const Pair& pair, Sums& sums) const
    {
        // What a term by itself ignores has not been listed for its pass.
        if (sizeof...(Terms) == 1 || !ignores(std::get<t>(terms), far.template of<t>()))
            std::get<t>(terms).add(near.template of<t>(), far.template of<t>(), pair, std::get<t>(sums));
    }
    template <std::size_t... t> void store(const Cluster& cluster, const Sums& sums, std::index_sequence<t...>) const
    {
        const auto keep = [&](const auto& term, bool has_work, const auto& own, const auto& sum) {
            if (has_work) term.store(cluster, own, sum);
        };
        (keep(std::get<t>(terms), !Local<Terms> || concerned[t], near.template of<t>(), std::get<t>(sums)), ...);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
