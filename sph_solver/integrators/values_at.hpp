#pragma once

#include "kernels/field_lanes.hpp"

/// Formulas of a particle that serve for a cluster as well: they ask `at(field)` for values, and `at.store()` to keep
/// them.
namespace cupel::inline CUPEL_ENGINE
{

/// A particle's values of fields.
struct OneParticle
{
    using Scalar = double;
    Index i;

    double operator()(const ScalarField& field) const { return field[i]; }
    Vector operator()(const VectorField& field) const { return field[i]; }
    void store(ScalarField& field, double value) const { field[i] = value; }
    void store(VectorField& field, const Vector& value) const { field.set(i, value); }
};

/// The same of those of a cluster that are chosen, a bit for each; in the precision of pair arithmetic.
struct SomeOfCluster
{
    using Scalar = Lanes;
    Index first;
    unsigned which;

    Lanes operator()(const ScalarField& field) const { return lanes(field, first); }
    VectorLanes operator()(const VectorField& field) const { return lanes(field, first); }
    void store(ScalarField& field, const Lanes& values) const { store_lanes(field, first, which, values); }
    void store(VectorField& field, const VectorLanes& values) const { store_lanes(field, first, which, values); }

    bool all() const { return which == (1u << lane_count) - 1u; }
    /// Those, zero elsewhere.
    Lanes chosen(const Lanes& a) const
    {
        if (all()) return a;
        Lanes some;
        for (int lane = 0; lane < lane_count; ++lane)
            if (which >> lane & 1u) some.set(lane, a[lane]);
        return some;
    }
};

/// The same vector for one particle or for each of a cluster.
template <class Scalar> VectorOf<Scalar> vector(const Vector& a)
{
    return {Scalar(a.x), Scalar(a.y), Scalar(a.z)};
}

inline double sum_of(double a)
{
    return a;
}
inline double sum_of(const Lanes& a)
{
    double sum = 0.0;
    for (int lane = 0; lane < lane_count; ++lane)
        sum += a[lane];
    return sum;
}

} // namespace cupel::inline CUPEL_ENGINE
