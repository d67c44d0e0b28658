#pragma once

#include "kernels/field_lanes.hpp"
#include "kernels/neighbour_list.hpp"

namespace cupel::inline CUPEL_ENGINE
{

#if CUPEL_REAL_IS_FLOAT

/// A position as the float nearest to it and what that float leaves out. The difference of two such floats that are
/// near each other is exact, so that the offset of a pair has the six digits of float wherever it lies: positions in
/// float alone would lose one digit for each power of ten between spacing and domain.
template <class Scalar> struct PlaceOf
{
    VectorOf<Scalar> nearest, rest;
};
using Place = PlaceOf<float>;
using PlaceLanes = PlaceOf<Lanes>;

inline VectorLanes offset_between(const PlaceLanes& i, const Place& j)
{
    return (i.nearest - broadcast(j.nearest)) + (i.rest - broadcast(j.rest));
}

/// Positions as the pair loop sees them, from the middle of the space that the particles span.
class Places
{
public:
    Places(const NeighbourList& list, const VectorField& position)
        : position_(position), middle_(0.5 * (list.lower() + list.upper()))
    {}

    Place operator()(Index i) const
    {
        const Vector p = position_[i] - middle_;
        const VectorOf<float> nearest = real(p);
        return {nearest, real(p - Vector{nearest.x, nearest.y, nearest.z})};
    }
    PlaceLanes of_cluster(Index first) const
    {
        Lanes::Register part[6];
        for (int lane = 0; lane < lane_count; ++lane) {
            const Place p = (*this)(first + lane);
            const float values[6] = {p.nearest.x, p.nearest.y, p.nearest.z, p.rest.x, p.rest.y, p.rest.z};
            for (int k = 0; k < 6; ++k)
                part[k][lane] = values[k];
        }
        return {{Lanes(part[0]), Lanes(part[1]), Lanes(part[2])}, {Lanes(part[3]), Lanes(part[4]), Lanes(part[5])}};
    }

private:
    const VectorField& position_;
    Vector middle_;
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
