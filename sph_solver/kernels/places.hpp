#pragma once

#include <algorithm>

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
struct PlaceLanes
{
    using Register = std::int32_t __attribute__((vector_size(64)));
    Register x, y, z;
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

    Place operator()(Index i) const
    {
        const Vector p = position_[i] - middle_;
        return {rounded(p.x), rounded(p.y), rounded(p.z)};
    }
    PlaceLanes lanes(Index first) const
    {
        PlaceLanes here{};
        for (int lane = 0; lane < lane_count; ++lane) {
            const Place place = (*this)(first + lane);
            here.x[lane] = place.x;
            here.y[lane] = place.y;
            here.z[lane] = place.z;
        }
        return here;
    }
    VectorLanes offset(const PlaceLanes& here, const Place& there) const
    {
        const auto along = [&](const PlaceLanes::Register& a, std::int32_t b) {
            return quantum_ * Lanes(__builtin_convertvector(a - b, Lanes::Register));
        };
        return {along(here.x, there.x), along(here.y, there.y), along(here.z, there.z)};
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

#else

using Place = Vector;
using PlaceLanes = VectorLanes;

/// Positions as the pair loop sees them: in double they are what they are.
class Places
{
public:
    Places(const NeighbourList&, const VectorField& position) : position_(position) {}

    Place operator()(Index i) const { return position_[i]; }
    PlaceLanes lanes(Index first) const { return cupel::lanes(position_, first); }
    VectorLanes offset(const PlaceLanes& here, const Place& there) const { return here - broadcast(there); }

private:
    const VectorField& position_;
};

#endif

} // namespace cupel::inline CUPEL_ENGINE
