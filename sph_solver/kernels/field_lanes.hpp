#pragma once

#include "math/lanes.hpp"
#include "particles/particles.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// A cluster's values of a field, in the precision of pair arithmetic.
inline Lanes lanes(const ScalarField& field, Index first)
{
    return load_lanes(field.values.data() + first);
}
inline VectorLanes lanes(const VectorField& field, Index first)
{
    return {load_lanes(field.x.data() + first), load_lanes(field.y.data() + first), load_lanes(field.z.data() + first)};
}

/// Writes the first `count` lanes: what follows belongs to the next cluster.
inline void store_lanes(ScalarField& field, Index first, int count, const Lanes& a)
{
    store_lanes(field.values.data() + first, a, count);
}
inline void store_lanes(VectorField& field, Index first, int count, const VectorLanes& a)
{
    store_lanes(field.x.data() + first, a.x, count);
    store_lanes(field.y.data() + first, a.y, count);
    store_lanes(field.z.data() + first, a.z, count);
}

/// One particle's value in the precision of pair arithmetic, for a term's record of a neighbour.
inline Real real(double value)
{
    return static_cast<Real>(value);
}
inline VectorOf<Real> real(const Vector& a)
{
    return {real(a.x), real(a.y), real(a.z)};
}

} // namespace cupel::inline CUPEL_ENGINE
