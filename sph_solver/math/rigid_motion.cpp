#include "math/rigid_motion.hpp"

#include <Eigen/Dense>

namespace cupel
{

namespace
{

/// m (x² 1 − x ⊗ x)
Symmetric3<double> inertia_of_point(double mass, const Vector& x)
{
    const double square = dot(x, x);
    Symmetric3<double> inertia{mass * square, 0.0, 0.0, mass * square, 0.0, mass * square};
    inertia.subtract_product(mass * x, x);
    return inertia;
}

} // namespace

RigidMoments RigidMoments::of(double mass, const Vector& place, const Vector& force)
{
    return {mass, mass * place, inertia_of_point(mass, place), force, cross(place, force)};
}

RigidMoments& RigidMoments::operator+=(const RigidMoments& other)
{
    mass += other.mass;
    first += other.first;
    inertia.xx += other.inertia.xx;
    inertia.xy += other.inertia.xy;
    inertia.xz += other.inertia.xz;
    inertia.yy += other.inertia.yy;
    inertia.yz += other.inertia.yz;
    inertia.zz += other.inertia.zz;
    force += other.force;
    torque += other.torque;
    return *this;
}

RigidAcceleration RigidMoments::acceleration() const
{
    const Vector centre = (1.0 / mass) * first;
    const Vector turning = torque - cross(centre, force);
    const Symmetric3<double> of_centre = inertia_of_point(mass, centre); // Steiner's theorem
    Eigen::Matrix3d matrix;
    matrix << inertia.xx - of_centre.xx, inertia.xy - of_centre.xy, inertia.xz - of_centre.xz, //
        inertia.xy - of_centre.xy, inertia.yy - of_centre.yy, inertia.yz - of_centre.yz,       //
        inertia.xz - of_centre.xz, inertia.yz - of_centre.yz, inertia.zz - of_centre.zz;
    // The shortest solution: nothing about axes without a moment of inertia.
    Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> decomposition;
    decomposition.setThreshold(1e-9);
    decomposition.compute(matrix);
    const Eigen::Vector3d angular = decomposition.solve(Eigen::Vector3d(turning.x, turning.y, turning.z));
    return {centre, (1.0 / mass) * force, {angular.x(), angular.y(), angular.z()}};
}

} // namespace cupel
