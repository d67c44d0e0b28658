#include <gtest/gtest.h>

#include <numbers>

#include "simulated.hpp"

namespace cupel
{
namespace
{

using namespace small_scenes;

/// A half disc of 20 spacings on a wall that asks for the angle given.
Case drop_on_a_wall(double contact_angle)
{
    Case definition = drop_in_nothing();
    definition.physics = {"flow", "surface_tension", "wetting"};
    definition.domain.lower = {0, 0, 0};
    definition.materials.at("liquid").contact_angle = contact_angle;
    Body& body = definition.bodies.front();
    body.center = {1, 0, 0};
    body.radius = 0.5;
    return definition;
}

class Wetting : public testing::TestWithParam<double>
{};
INSTANTIATE_TEST_SUITE_P(Angles, Wetting, testing::Values(105.0, 120.0, 150.0));

TEST_P(Wetting, WallsContinueAnOverhangAtYoungsAngleWhateverTheLiquidsOwn)
{
    // The surface stands upright on the wall; within the wall it has to go on at the angle that is asked for. Colours
    // between 0 and 1 say how deep below it a wall particle lies, in spacings.
    const double angle = GetParam() * std::numbers::pi / 180.0, spacing = 0.05;
    Simulation simulation = simulate(drop_on_a_wall(angle), 1);
    const Particles& particles = simulation.particles();
    const ScalarField& colour = particles.scalar("colour");
    const Vector normal{std::sin(angle), 0.0, std::cos(angle)};
    double nearest = 1e9, furthest = -1e9;
    int seen = 0;
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = particles.position[i];
        const bool at_the_right = particles.kind[static_cast<std::size_t>(i)] == Kind::wall && p.z < 0.0 && p.x > 1.0;
        if (!at_the_right || colour[i] <= 0.0 || colour[i] >= 1.0) continue;
        const double place = dot(p, normal) + (colour[i] - 0.5) * spacing; // of the surface, along its normal
        nearest = std::min(nearest, place);
        furthest = std::max(furthest, place);
        ++seen;
    }
    EXPECT_GE(seen, 2);
    // Columns of the wall see the surface through kernels of their own.
    EXPECT_LT(furthest - nearest, 0.15 * spacing);
}

TEST(ContactPull, NothingPullsUnderAFreeSurfaceThatOverhangs)
{
    const auto pulls = [](double degrees) {
        return simulate(drop_on_a_wall(degrees * std::numbers::pi / 180.0), 1).particles().has("contact_pull");
    };
    EXPECT_TRUE(pulls(60.0));
    EXPECT_TRUE(pulls(90.0));
    EXPECT_FALSE(pulls(105.0));
}

} // namespace
} // namespace cupel
