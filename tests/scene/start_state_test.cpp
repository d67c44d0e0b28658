#include "temporary_case.hpp"

#include "scene/shape.hpp"

#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

namespace cupel
{
namespace
{

using testing::drop_case;
using ::testing::HasSubstr;
using testing::refusal;
using testing::replaced;
using testing::resolved;
using ::testing::StartsWith;

const std::vector<std::string> layer{
    "body.0={shape=\"box\",material=\"oil\",state=\"liquid\",lower=[\"-1 mm\",\"0 mm\","
    "\"-1 mm\"],upper=[\"1 mm\",\"0 mm\",\"0 mm\"]}"};

std::vector<std::string> with(std::vector<std::string> overrides, const std::string& more)
{
    overrides.push_back(more);
    return overrides;
}

TEST(Tier, IsNoneUnlessNamed)
{
    EXPECT_TRUE(resolved(drop_case).at("tier").is_null());
    EXPECT_EQ(resolved(drop_case, {"tier=v0"}).at("tier"), "v0");
    EXPECT_THAT(refusal(drop_case, {"tier=v7"}), HasSubstr("take one of: canonical, v0, v1, v2"));
}

TEST(WallVelocity, IsAlongAWallThatDoesNotSlip)
{
    const std::string key = "domain.boundaries.x_min.velocity=";
    const nlohmann::json still = resolved(drop_case).at("domain").at("boundaries");
    EXPECT_EQ(still.at("z_max").at("velocity"), nlohmann::json::array({0.0, 0.0, 0.0}));
    const Case moving = case_from_resolved(resolved(drop_case, {key + "[\"0 m/s\",\"0 m/s\",\"2 m/s\"]"}));
    EXPECT_EQ(moving.domain.boundary(Side::x_min)->velocity, (Vector3{0, 0, 2}));
    EXPECT_THAT(refusal(drop_case, {key + "[\"1 m/s\",\"0 m/s\",\"0 m/s\"]"}), HasSubstr("out of its plane"));
    EXPECT_THAT(refusal(drop_case, {key + "[\"0 m/s\",\"1 m/s\",\"0 m/s\"]"}), HasSubstr("the plane y = 0"));
    EXPECT_THAT(refusal(drop_case, {"domain.boundaries.z_max.velocity=[\"1 m/s\",\"0 m/s\",\"0 m/s\"]"}),
                HasSubstr("has no meaning with kind = \"open\""));
    EXPECT_THAT(refusal(drop_case, {key + "[\"0 m/s\",\"0 m/s\",\"1 m/s\"]", "domain.boundaries.x_min.slip=free_slip"}),
                HasSubstr("has no meaning with slip"));
}

TEST(InitialVelocity, IsTaylorGreensSolenoidalField)
{
    EXPECT_TRUE(resolved(drop_case).at("initial").at("velocity").is_null());
    const std::string key = "initial.velocity={field=\"taylor_green\",speed=\"2 m/s\",wavelength=\"1 mm\"}";
    const Case definition = case_from_resolved(resolved(drop_case, {key}));
    const TaylorGreen& field = *definition.initial.velocity;
    const Vector3 at = field.velocity({2.5e-4, 0, 0});
    EXPECT_DOUBLE_EQ(at[0], 2.0); // U sin(pi/2) cos(0)
    EXPECT_NEAR(at[2], 0.0, 1e-12);
    const double step = 1e-8;
    const Vector3 place{1.3e-4, 0, 0.7e-4};
    const double divergence =
        (field.velocity({place[0] + step, 0, place[2]})[0] - field.velocity({place[0] - step, 0, place[2]})[0] +
         field.velocity({place[0], 0, place[2] + step})[2] - field.velocity({place[0], 0, place[2] - step})[2]) /
        (2 * step);
    EXPECT_NEAR(divergence, 0.0, 1e-3); // of gradients of 1e4 1/s
    EXPECT_THAT(refusal(drop_case, {key, "physics=[\"heat\"]", "material.oil.specific_heat=1 J/(kg K)",
                                    "material.oil.conductivity=1 W/(m K)"}),
                HasSubstr("'flow' is not among the physics"));
    EXPECT_THAT(refusal(drop_case, {"initial.velocity={field=\"taylor_green\",speed=\"2 m/s\",wavelength=\"1.3 mm\"}",
                                    "domain.boundaries.x_min.kind=periodic", "domain.boundaries.x_max.kind=periodic"}),
                StartsWith("--set:1:1: initial.velocity.wavelength: does not fit a whole number of times"));
}

TEST(HotSpot, AddsAGaussianAroundItsAxis)
{
    const Case definition = case_from_resolved(resolved(
        drop_case, {"initial.hot_spot={center=[\"0.1 mm\",\"0 mm\",\"0 mm\"],radius=\"0.2 mm\",rise=\"50 K\"}"}));
    EXPECT_DOUBLE_EQ(definition.initial_temperature({1e-4, 0, 9e-4}), 350);
    EXPECT_NEAR(definition.initial_temperature({3e-4, 0, 0}), 300 + 50 * std::exp(-2), 1e-12);
    EXPECT_THAT(refusal(drop_case,
                        {"initial.hot_spot={center=[\"0 mm\",\"0 mm\",\"0 mm\"],radius=\"0.2 mm\",rise=\"-400 K\"}"}),
                HasSubstr("initial.hot_spot.rise: makes its middle as cold as -100.0 K"));
}

TEST(HotSpot, IsEnoughForMarangoniWithoutHeat)
{
    const std::vector<std::string> overrides{
        "physics=[\"flow\",\"marangoni\"]", "material.oil.surface_tension_slope=-1 mN/(m K)",
        "initial.hot_spot={center=[\"0 mm\",\"0 mm\",\"0 mm\"],radius=\"0.2 mm\",rise=\"4 K\"}"};
    EXPECT_EQ(refusal(drop_case, overrides), "");
}

TEST(BodyTemperature, HoldsInsideTheUppermostBodyOnly)
{
    const std::string second = "[[body]]\nshape = \"sphere\"\nmaterial = \"oil\"\nstate = \"liquid\"\n"
                               "center = [\"0 mm\", \"0 mm\", \"0 mm\"]\nradius = \"0.1 mm\"\n";
    const std::vector<std::string> heat{"physics=[\"heat\"]", "material.oil.specific_heat=1 J/(kg K)",
                                        "material.oil.conductivity=1 W/(m K)", "body.0.temperature=700 K"};
    const Case definition = case_from_resolved(resolved(drop_case + second, heat));
    EXPECT_EQ(definition.initial_temperature({3e-4, 0, 0}), 700);
    EXPECT_EQ(definition.initial_temperature({0, 0, 0}), 300); // the second body lies over it
    EXPECT_EQ(definition.initial_temperature({8e-4, 0, 0}), 300);
    EXPECT_THAT(refusal(drop_case, {"body.0.temperature=700 K"}), HasSubstr("has no meaning without 'heat'"));
}

TEST(Perturbation, GoesWithSpheresOnly)
{
    EXPECT_THAT(refusal(drop_case, with(layer, "body.0.perturbation={mode=2,amplitude=0.01}")),
                HasSubstr("body.0.perturbation: has no meaning with shape = \"box\""));
    EXPECT_THAT(refusal(drop_case, {"body.0.perturbation={mode=1,amplitude=0.01}"}), HasSubstr("at least 2"));
    EXPECT_THAT(refusal(drop_case, {"body.0.surface_wave={amplitude=\"1 um\",wavelength=\"1 mm\"}"}),
                HasSubstr("has no meaning with shape = \"sphere\""));
    EXPECT_TRUE(resolved(drop_case).at("bodies")[0].at("perturbation").is_null());
    EXPECT_TRUE(resolved(drop_case).at("bodies")[0].at("surface_wave").is_null());
}

TEST(SurfaceWave, FitsIntoAPeriodicDomain)
{
    const std::vector<std::string> periodic =
        with(with(layer, "domain.boundaries.x_min.kind=periodic"), "domain.boundaries.x_max.kind=periodic");
    EXPECT_EQ(refusal(drop_case, with(periodic, "body.0.surface_wave={amplitude=\"1 um\",wavelength=\"1 mm\"}")), "");
    EXPECT_THAT(refusal(drop_case, with(periodic, "body.0.surface_wave={amplitude=\"1 um\",wavelength=\"1.2 mm\"}")),
                HasSubstr("does not fit a whole number of times"));
    EXPECT_THAT(refusal(drop_case, with(periodic, "body.0.surface_wave={amplitude=\"1 mm\",wavelength=\"1 mm\"}")),
                HasSubstr("reaches below the box"));
}

/// A drop of R = 2 around (0, 0, 1) with a mode.
Body perturbed(int mode, double amplitude)
{
    Body body;
    body.shape = BodyShape::sphere;
    body.center = {0, 0, 1};
    body.radius = 2;
    body.perturbation = Perturbation{mode, amplitude};
    return body;
}

double divergence_of_displacement(const Body& body, const Domain& domain, const Vector3& place, int dimensions)
{
    const double step = 1e-5;
    double divergence = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Vector3 ahead = place, behind = place;
        ahead[axis] += step;
        behind[axis] -= step;
        divergence += (displacement(body, domain, ahead, dimensions)[axis] -
                       displacement(body, domain, behind, dimensions)[axis]) /
                      (2 * step);
    }
    return divergence;
}

TEST(Displacement, CarriesTheRoundSurfaceOntoThePerturbedOne)
{
    const double a = 1e-4;
    for (const int dimensions : {2, 3})
        for (const int mode : {2, 3, 4}) {
            const Body body = perturbed(mode, a);
            for (double angle = 0.1; angle < std::numbers::pi; angle += 0.3)
                for (const double nearly : {1.0 - 1e-9, 1.0 + 1e-9}) { // from inside and from outside
                    const double azimuth = dimensions == 3 ? 0.7 : 0.0;
                    const Vector3 place{2 * nearly * std::sin(angle) * std::cos(azimuth),
                                        2 * nearly * std::sin(angle) * std::sin(azimuth),
                                        1 + 2 * nearly * std::cos(angle)};
                    const Vector3 moved = displacement(body, {}, place, dimensions);
                    const double radius = std::hypot(place[0] + moved[0], place[1] + moved[1], place[2] + moved[2] - 1);
                    const double c = std::cos(angle);
                    const double p[] = {0, 0, (3 * c * c - 1) / 2, (5 * c * c * c - 3 * c) / 2,
                                        (35 * c * c * c * c - 30 * c * c + 3) / 8};
                    const double shape = dimensions == 2 ? std::cos(mode * angle) : p[mode];
                    EXPECT_NEAR(radius, 2 * (1 + a * shape), 40 * a * a) << dimensions << " " << mode << " " << angle;
                }
        }
}

/// By how much a displacement changes a small volume, as its share; in two dimensions along x and z.
double volume_ratio(const Body& body, const Domain& domain, const Vector3& place, int dimensions)
{
    const double step = 1e-5;
    std::array<Vector3, 3> columns{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Vector3 ahead = place, behind = place;
        ahead[axis] += step;
        behind[axis] -= step;
        const Vector3 a = displacement(body, domain, ahead, dimensions),
                      b = displacement(body, domain, behind, dimensions);
        for (std::size_t row = 0; row < 3; ++row)
            columns[axis][row] = (axis == row ? 1.0 : 0.0) + (a[row] - b[row]) / (2 * step);
    }
    const auto& [x, y, z] = columns;
    return x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2]) + x[2] * (y[0] * z[1] - y[1] * z[0]);
}

TEST(Displacement, MovesNoVolume)
{
    for (const int mode : {2, 3, 5})
        for (const Vector3& place : {Vector3{0.7, 0, 1.9}, Vector3{-1.1, 0, 0.4}, Vector3{2.5, 0, 2.1}}) {
            EXPECT_NEAR(volume_ratio(perturbed(mode, 0.05), {}, place, 2), 1, 1e-7) << mode;
            EXPECT_NEAR(volume_ratio(perturbed(mode, 0.05), {}, {place[0], 0.3, place[2]}, 3), 1, 1e-7) << mode;
        }
}

TEST(Displacement, DoesNotSlipAlongTheSurfaceAndEndsAtTheSidesOfTheDomain)
{
    Domain domain;
    domain.lower = {-3, -3, -2};
    domain.upper = {3, 3, 4};
    for (const int dimensions : {2, 3})
        for (const int mode : {2, 3}) {
            const Body body = perturbed(mode, 0.01);
            for (double angle = 0.2; angle < std::numbers::pi; angle += 0.4) {
                const auto at = [&](double radius) {
                    return displacement(body, domain, {radius * std::sin(angle), 0, 1 + radius * std::cos(angle)},
                                        dimensions);
                };
                const Vector3 inside = at(2.0 - 1e-7), outside = at(2.0 + 1e-7), side = at(3.0);
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    EXPECT_NEAR(inside[axis], outside[axis], 1e-8);
                    EXPECT_EQ(side[axis], 0.0);
                }
            }
        }
}

TEST(Displacement, OfAWaveEndsAtTheBottomAndRaisesTheSurfaceByItself)
{
    Body body;
    body.lower = {0, 0, 0};
    body.upper = {1, 0, 0.4};
    body.surface_wave = SurfaceWave{1e-4, 1.0};
    Domain domain;
    domain.upper = {1, 0, 1};
    EXPECT_NEAR(displacement(body, domain, {0, 0, 0.4}, 2)[2], 1e-4, 1e-16);
    EXPECT_NEAR(displacement(body, domain, {0.5, 0, 0.4 - 1e-12}, 2)[2], -1e-4, 1e-12);
    EXPECT_EQ(displacement(body, domain, {0.2, 0, 0}, 2)[2], 0);
    EXPECT_NEAR(displacement(body, domain, {0.2, 0, 1}, 2)[2], 0, 1e-20);
    EXPECT_NEAR(divergence_of_displacement(body, domain, {0.2, 0, 0.3}, 2), 0, 1e-9);
    EXPECT_NEAR(divergence_of_displacement(body, domain, {0.2, 0, 0.7}, 2), 0, 1e-9);
}

TEST(Shape, PerturbationAndWaveBoundTheBody)
{
    const Body body = perturbed(2, 0.1); // 2.2 upward, 1.8 sideways in two dimensions, 1.9 in three
    EXPECT_TRUE(contains(body, {0, 0, 3.19}, 2));
    EXPECT_FALSE(contains(body, {0, 0, 3.21}, 2));
    EXPECT_FALSE(contains(body, {1.81, 0, 1}, 2));
    EXPECT_TRUE(contains(body, {1.89, 0, 1}, 3));
    EXPECT_TRUE(contains_undisturbed(body, {1.95, 0, 1}, 3));
}

} // namespace
} // namespace cupel
