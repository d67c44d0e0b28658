#pragma once

#include "math/lanes.hpp"
#include "particles/particles.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// A cluster's values of a field, in the precision of pair arithmetic.
[[gnu::always_inline]] inline Lanes lanes(const ScalarField& field, Index first)
{
    return load_lanes(field.values.data() + first);
}
[[gnu::always_inline]] inline VectorLanes lanes(const VectorField& field, Index first)
{
    return {load_lanes(field.x.data() + first), load_lanes(field.y.data() + first), load_lanes(field.z.data() + first)};
}

/// Writes the lanes whose bits are set in `which`: the others belong to somebody else.
inline void store_lanes(ScalarField& field, Index first, unsigned which, const Lanes& a)
{
    store_lanes(field.values.data() + first, which, a);
}
inline void store_lanes(VectorField& field, Index first, unsigned which, const VectorLanes& a)
{
    store_lanes(field.x.data() + first, which, a.x);
    store_lanes(field.y.data() + first, which, a.y);
    store_lanes(field.z.data() + first, which, a.z);
}

/// How many lanes is not which.
void store_lanes(ScalarField& field, Index first, int count, const Lanes& a) = delete;
void store_lanes(VectorField& field, Index first, int count, const VectorLanes& a) = delete;

/// Has the processor fetch a cluster's values of fields ahead of time. A pass goes through more fields than it can
/// foresee by itself.
inline void prefetch(const Array& values, Index first)
{
    const double* const cluster = values.data() + first;
    // Of each cache line the last: the first of them came with the cluster before.
    for (int line = 8; line <= lane_count; line += 8)
        __builtin_prefetch(cluster + line - 1);
}
inline void prefetch(const ScalarField& field, Index first)
{
    prefetch(field.values, first);
}
inline void prefetch(const VectorField& field, Index first)
{
    for (const Array* const component : {&field.x, &field.y, &field.z})
        prefetch(*component, first);
}
template <class... Fields> void prefetch_all(Index first, const Fields&... fields)
{
    (prefetch(fields, first), ...);
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
