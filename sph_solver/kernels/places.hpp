#pragma once

#include <algorithm>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "kernels/field_lanes.hpp"
#include "kernels/neighbour_list.hpp"

namespace cupel::inline CUPEL_ENGINE
{

#if CUPEL_REAL_IS_FLOAT

/// A position as a whole number of quanta, 2⁻³¹ of the space that the particles span. Differences of whole numbers are
/// exact, so that the offset of a pair has the six digits of float wherever it lies: positions in float themselves
/// would lose one digit for each power of ten between spacing and domain.
struct Place
{
    std::int32_t x, y, z;
};
class Places
{
public:
    Places(const NeighbourList& list, const VectorField& position)
        : position_(position), middle_(0.5 * (list.lower() + list.upper()))
    {
        const Vector span = list.upper() - list.lower();
        // Particles stay within the list's skin of where they were when it was built.
        const double reach = std::max({span.x, span.y, span.z}) + 4.0 * list.support();
        quantum_ = reach / 2147483648.0;
        quanta_ = 1.0 / quantum_;
    }
    double quantum() const { return quantum_; }
    const VectorField& position() const { return position_; }

    Place operator()(Index i) const
    {
        const Vector p = position_[i] - middle_;
        return {rounded(p.x), rounded(p.y), rounded(p.z)};
    }

private:
    std::int32_t rounded(double distance) const
    {
        return static_cast<std::int32_t>(std::clamp(distance * quanta_, -1073741824.0, 1073741823.0));
    }

    const VectorField& position_;
    Vector middle_;
    double quantum_ = 0.0, quanta_ = 0.0;
};

/// Offsets between a cluster and its neighbours, one neighbour after the other. All are first taken relative to one of
/// the cluster's own, and are then near enough for float.
class Surroundings
{
public:
    explicit Surroundings(const Places& places) : places_(places), quantum_(static_cast<float>(places.quantum())) {}

    /// place(j) gives a neighbour's, as a Place or as the position itself.
    template <class PlaceOf> void centre_on(Index first, std::span<const Run> runs, const PlaceOf& place)
    {
        expand(runs);
        if constexpr (std::is_convertible_v<decltype(place(first)), Place>) {
            const Quanta origin = loaded(places_(first));
            take(
                first, [&](Index i) { return relative(places_(i), origin); },
                [&](Index j) { return relative(place(j), origin); });
        }
        else {
            const Vector origin = places_.position()[first];
            const auto relative_position = [&](Index j) {
                const Vector offset = places_.position()[j] - origin;
                return Near{real(offset.x), real(offset.y), real(offset.z), 0};
            };
            take(first, relative_position, relative_position);
        }
    }
    template <class Visit> void for_each_neighbour(const Visit& visit)
    {
        next_ = near_.data();
        for (std::size_t k = 0; k < count_; ++k)
            visit(neighbours_[k]);
    }
    /// To the neighbours in turn; to be called once for each.
    VectorLanes next_offset(const Place&)
    {
        const float* near = next_;
        next_ += 4;
        return here_ - VectorLanes{near[0], near[1], near[2]};
    }

private:
    using Quanta = std::int32_t __attribute__((vector_size(16)));
    using Near = float __attribute__((vector_size(16)));

    static Quanta loaded(const Place& place) { return Quanta{place.x, place.y, place.z, 0}; }
    Near relative(const Place& place, const Quanta& origin) const
    {
        return quantum_ * __builtin_convertvector(loaded(place) - origin, Near);
    }
    /// The neighbours one by one: where one run ends and the next begins, no processor can foresee.
    void expand(std::span<const Run> runs)
    {
        constexpr Index at_once = 16;
        count_ = 0;
        for (const Run& run : runs)
            count_ += static_cast<std::size_t>(run.count);
        if (neighbours_.size() < count_ + at_once) {
            neighbours_.resize(2 * (count_ + at_once));
            near_.resize(4 * neighbours_.size());
        }
        Index* next = neighbours_.data();
        for (const Run& run : runs) {
            for (Index begin = 0; begin < run.count; begin += at_once)
                for (Index k = begin; k < begin + at_once; ++k)
                    next[k] = run.first + k;
            next += run.count;
        }
    }
    template <class Own, class Others> void take(Index first, const Own& own, const Others& others)
    {
        Lanes::Register x{}, y{}, z{};
        for (int lane = 0; lane < lane_count; ++lane) {
            const Near near = own(first + lane);
            x[lane] = near[0];
            y[lane] = near[1];
            z[lane] = near[2];
        }
        here_ = {Lanes(x), Lanes(y), Lanes(z)};
        float* next = near_.data();
        for (std::size_t k = 0; k < count_; ++k, next += 4) {
            const Near near = others(neighbours_[k]);
            std::memcpy(next, &near, sizeof near);
        }
    }

    const Places& places_;
    float quantum_;
    VectorLanes here_;
    std::size_t count_ = 0;
    std::vector<Index> neighbours_;
    const float* next_ = nullptr;
    std::vector<float> near_; ///< x, y, z and nothing, of each neighbour in turn
};

#else

using Place = Vector;

/// Positions as the pair loop sees them: in double they are what they are.
class Places
{
public:
    Places(const NeighbourList&, const VectorField& position) : position_(position) {}

    Place operator()(Index i) const { return position_[i]; }
    const VectorField& position() const { return position_; }

private:
    const VectorField& position_;
};

/// Offsets between a cluster and its neighbours, one neighbour after the other.
class Surroundings
{
public:
    explicit Surroundings(const Places& places) : places_(places) {}

    template <class PlaceOf> void centre_on(Index first, std::span<const Run> runs, const PlaceOf&)
    {
        runs_ = runs;
        here_ = lanes(places_.position(), first);
    }
    template <class Visit> void for_each_neighbour(const Visit& visit) const
    {
        for (const Run& run : runs_)
            for (Index j = run.first; j < run.first + run.count; ++j)
                visit(j);
    }
    VectorLanes next_offset(const Place& place) const { return here_ - broadcast(place); }

private:
    const Places& places_;
    std::span<const Run> runs_;
    VectorLanes here_;
};

#endif

} // namespace cupel::inline CUPEL_ENGINE
