#pragma once

#include "math/vector.hpp"

namespace cupel
{

/// How a rigid body is accelerated:   a(x) = a_c + α × (x − x_c)
struct RigidAcceleration
{
    Vector centre;  ///< x_c, of mass, m
    Vector linear;  ///< a_c, m/s²
    Vector angular; ///< α, rad/s²

    Vector at(const Vector& place) const { return linear + cross(angular, place - centre); }
};

/// Sums over a body's particles, of masses and of forces that act on them, from which its rigid motion follows. Places
/// are measured from an origin of the caller's choice, best within the body.
struct RigidMoments
{
    double mass = 0.0;            ///< Σ m, kg
    Vector first{};               ///< Σ m x, kg m
    Symmetric3<double> inertia{}; ///< Σ m (x² 1 − x ⊗ x), kg m²
    Vector force{};               ///< Σ F, N
    Vector torque{};              ///< Σ x × F, N m

    static RigidMoments of(double mass, const Vector& place, const Vector& force);
    RigidMoments& operator+=(const RigidMoments& other);

    /// The acceleration of a rigid body by these forces:   M a_c = Σ F,   I_c α = Σ (x − x_c) × F.   What has no
    /// extent about an axis (a line, a single particle, in two dimensions all but one) does not turn about it.
    RigidAcceleration acceleration() const;
};

} // namespace cupel
