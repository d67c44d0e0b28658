/// The greatest expected speed of a scene, from which the artificial sound speed follows.
#include "integrators/parameters.hpp"

#include "small_scenes.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace cupel
{
namespace
{

FlowParameters parameters_of(Case definition)
{
    definition.numerics.reference_speed.reset();
    return derive_flow_parameters(place_particles(definition));
}

TEST(FlowParameters, FollowTheVelocityAtTheStart)
{
    Case definition = small_scenes::pool();
    definition.initial.velocity = TaylorGreen{3.0, 1.0};
    EXPECT_DOUBLE_EQ(parameters_of(definition).reference_speed, 3.0);
    EXPECT_EQ(parameters_of(definition).reference_speed_from, "velocity at the start");
}

TEST(FlowParameters, FollowAMovingWall)
{
    Case definition = small_scenes::pool();
    definition.domain.boundaries[std::size_t(Side::z_min)]->velocity = {-2.0, 0, 0};
    EXPECT_DOUBLE_EQ(parameters_of(definition).reference_speed, 2.0);
}

TEST(FlowParameters, FollowTheSteepestPartOfAHotSpot)
{
    Case definition = small_scenes::pool();
    definition.physics = {"flow", "marangoni"};
    Material& liquid = definition.materials.at("liquid");
    liquid.surface_tension_slope = -0.01;
    definition.initial.hot_spot = HotSpot{{1, 0, 0}, 0.5, 100.0};
    // dT/dr of rise exp(-2 r^2/R^2) is greatest at r = R/2; length 1, viscosity 0.05
    const double gradient = 4.0 * 0.25 / 0.25 * 100.0 * std::exp(-0.5);
    EXPECT_NEAR(parameters_of(definition).reference_speed, 0.01 * gradient / (4 * 0.05), 1e-9);
}

TEST(TimeStepLimits, SoundIsFasterInTheLighterOfTwoPhases)
{
    Case definition = small_scenes::pool();
    definition.initial.velocity = TaylorGreen{3.0, 1.0};
    Material outside = definition.materials.at("liquid");
    outside.name = "outside";
    definition.materials.emplace("outside", outside);
    definition.surrounding.emplace();
    definition.surrounding->material = "outside";
    definition.surrounding->resolved = true;
    const auto acoustic = [&](double density) {
        definition.materials.at("outside").density = density * definition.materials.at("liquid").density;
        const Scene scene = place_particles(definition);
        return derive_time_step_limits(scene, derive_flow_parameters(scene)).at("acoustic");
    };
    // rho c^2 is one for both, so that c goes with the root of the density ratio, whichever phase is the lighter.
    EXPECT_NEAR(acoustic(0.01) / acoustic(1.0), 0.1, 1e-12);
    EXPECT_NEAR(acoustic(100.0) / acoustic(1.0), 0.1, 1e-12);
}

TEST(FlowParameters, SceneWithoutAnyForceIsRefused)
{
    EXPECT_THROW(parameters_of(small_scenes::pool()), CaseError);
}

} // namespace
} // namespace cupel
