#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "kernels/field_lanes.hpp"
#include "kernels/neighbour_list.hpp"

namespace cupel::inline CUPEL_ENGINE
{

#if CUPEL_REAL_IS_FLOAT

/// A position as a whole number of parts, of which the space that the particles span has 2^31 along its longest side.
/// The difference of two is exact, so that the offset of a pair has the digits of float wherever it lies (a part is
/// 10^-7 spacings in a space of 200), in half the memory that a float and its remainder would take.
struct Place
{
    std::int32_t x, y, z;
};
struct PlaceLanes
{
    Packed<std::int32_t> x, y, z;
    Lanes part; ///< m
};

inline VectorLanes offset_between(const PlaceLanes& i, const Place& j)
{
    const auto along = [&](const Packed<std::int32_t>& here, std::int32_t there) {
        const auto difference = [&](const auto& some) {
            using Floats = float __attribute__((vector_size(register_bytes)));
            return __builtin_convertvector(some - there, Floats);
        };
        return Lanes(in_registers(difference, here)) * i.part;
    };
    return {along(i.x, j.x), along(i.y, j.y), along(i.z, j.z)};
}

/// Positions as the pair loop sees them, from the middle of the space that the particles span. It reaches a support
/// beyond where they were when they were listed: none has moved so far since.
class Places
{
public:
    Places(const NeighbourList& list, const VectorField& position)
        : position_(position), middle_(0.5 * (list.lower() + list.upper()))
    {
        const Vector extent = list.upper() - list.lower();
        // A float, so that lengths in parts lose nothing when they are turned back.
        part_ = real((std::max({extent.x, extent.y, extent.z}) + 2.0 * list.support()) / (2.0 * most));
    }

    Place operator()(Index i) const
    {
        const Vector p = (1.0 / part_) * (position_[i] - middle_);
        return {whole(p.x), whole(p.y), whole(p.z)};
    }
    PlaceLanes of_cluster(Index first) const
    {
        PlaceLanes places;
        places.part = Lanes(part_);
        for (int lane = 0; lane < lane_count; ++lane) {
            const Place p = (*this)(first + lane);
            set_number_at(places.x, lane, p.x);
            set_number_at(places.y, lane, p.y);
            set_number_at(places.z, lane, p.z);
        }
        return places;
    }

private:
    static constexpr double most = 1 << 30;
    /// Of what is no number one end: guards look at positions, not at these.
    static std::int32_t whole(double parts)
    {
        return parts > -most ? static_cast<std::int32_t>(std::lrint(std::min(parts, most))) : -(1 << 30);
    }

    const VectorField& position_;
    Vector middle_;
    double part_; ///< m
};

#else

using Place = Vector;
using PlaceLanes = VectorLanes;

inline VectorLanes offset_between(const PlaceLanes& i, const Place& j)
{
    return i - broadcast(j);
}

/// Positions as the pair loop sees them: in double they are what they are.
class Places
{
public:
    Places(const NeighbourList&, const VectorField& position) : position_(position) {}

    Place operator()(Index i) const { return position_[i]; }
    PlaceLanes of_cluster(Index first) const { return lanes(position_, first); }

private:
    const VectorField& position_;
};

#endif

} // namespace cupel::inline CUPEL_ENGINE
