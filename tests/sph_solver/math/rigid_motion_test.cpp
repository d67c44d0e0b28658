/// Rigid motion that forces on a body's particles give it.
#include "math/rigid_motion.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace cupel
{
namespace
{

void expect_near(const Vector& a, const Vector& b, double tolerance)
{
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

RigidMoments moments_of(const std::vector<Vector>& places, const std::vector<double>& masses,
                        const RigidAcceleration& acceleration)
{
    RigidMoments moments;
    for (std::size_t k = 0; k < places.size(); ++k)
        moments += RigidMoments::of(masses[k], places[k], masses[k] * acceleration.at(places[k]));
    return moments;
}

const std::vector<Vector> tetrahedron{{10, 0, 0}, {11, 0, 0}, {10, 2, 0}, {10, 0, 3}};

TEST(RigidMotion, IsFoundFromTheForcesThatMakeIt)
{
    const std::vector<double> masses{1, 2, 3, 4};
    const Vector centre{10.2, 0.6, 1.2}; // of mass
    const RigidAcceleration given{centre, {1, -2, 3}, {0.4, 0.5, -0.6}};
    const RigidAcceleration found = moments_of(tetrahedron, masses, given).acceleration();
    expect_near(found.centre, centre, 1e-13);
    expect_near(found.linear, given.linear, 1e-13);
    expect_near(found.angular, given.angular, 1e-12);
}

TEST(RigidMotion, OfForcesThatTurnNothingIsNone)
{
    RigidMoments moments;
    // Along the line between two particles, one against the other.
    moments += RigidMoments::of(1.0, {0, 0, 0}, {-1, -1, -1});
    moments += RigidMoments::of(5.0, {2, 2, 2}, {1, 1, 1});
    const RigidAcceleration found = moments.acceleration();
    expect_near(found.linear, {}, 1e-15);
    expect_near(found.angular, {}, 1e-15);
}

TEST(RigidMotion, HasNoRotationAboutAnAxisWithoutExtent)
{
    // A line turns about what is across it alone, a particle about nothing.
    const std::vector<Vector> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    const RigidAcceleration given{{1, 0, 0}, {}, {7, 0, 2}};
    expect_near(moments_of(line, {1, 1, 1}, given).acceleration().angular, {0, 0, 2}, 1e-13);
    const RigidAcceleration particle = RigidMoments::of(2.0, {5, 6, 7}, {4, 0, 0}).acceleration();
    expect_near(particle.linear, {2, 0, 0}, 1e-15);
    expect_near(particle.angular, {}, 1e-15);
}

} // namespace
} // namespace cupel
