#include <gtest/gtest.h>

#include <numbers>

#include "models/laser.hpp"
#include "thermal/thermal_scene.hpp"

namespace cupel::thermal_tests
{
namespace
{

constexpr double spot_radius = 8e-5;

/// Of the beam as rays have it, wider for the sake of particles (laser.hpp), m².
double widened_square(double dx)
{
    return spot_radius * spot_radius + 4 * 2 * (0.19 - 1.0 / 32) * dx * dx;
}

Laser beam_at(double x, double y)
{
    Laser laser;
    laser.power = 150;
    laser.speed = 0;
    laser.spot_radius = spot_radius;
    laser.absorptivity = 0.35;
    laser.from = laser.to = {x, y};
    return laser;
}

struct Lit
{
    Scene scene;
    LaserBeam::Power power;

    double heating(Index i) const { return scene.particles->scalar("heating_power")[i]; }
    /// Power of the particles for which choose(position) holds, W.
    template <class Choose> double total(const Choose& choose) const
    {
        double sum = 0.0;
        for (Index i = 0; i < scene.particles->count(); ++i)
            if (choose(scene.particles->position[i])) sum += heating(i);
        return sum;
    }
};

Lit shine(Scene scene, const Laser& laser, double time = 0, double time_step = 1e-6)
{
    Particles& particles = *scene.particles;
    ScalarField& metal = particles.add_scalar({"metal", "1"}, 1.0);
    ScalarField& heating = particles.add_scalar({"heating_power", "W"});
    LaserBeam beam(laser, scene.spacing, scene.dimensions);
    const LaserBeam::Power power = beam.illuminate(particles, metal, time, time_step, heating);
    return {std::move(scene), power};
}

Scene plate(double dx, double jitter = 0.0, double half = 2.4e-4)
{
    return lattice_scene(heat_case(plain_metal(), 3, dx), {-half, -half, -4 * dx}, {half, half, 0}, jitter);
}

TEST(LaserBeam, FlatSurfaceAbsorbsAllOfTheBeamTimesItsAbsorptivity)
{
    for (const double dx : {4e-5, 2e-5, 1e-5}) {
        const Lit lit = shine(plate(dx), beam_at(3.3e-6, -7.1e-6));
        EXPECT_NEAR(lit.power.emitted, 150, 1e-9);
        EXPECT_NEAR(lit.power.hit, 150, 150e-3) << dx;
        EXPECT_NEAR(lit.power.absorbed, 0.35 * lit.power.hit, 1e-10);
        EXPECT_NEAR(lit.total([](const Vector&) { return true; }), 0.35 * lit.power.hit, 1e-10);
        EXPECT_NEAR(lit.total([&](const Vector& p) { return p.z > -dx; }), 0.35 * lit.power.hit, 1e-10);
    }
}

TEST(LaserBeam, RoughSurfaceAbsorbsTheSameAndHasNoHoles)
{
    const double dx = 2e-5;
    for (const double jitter : {0.2, 0.5}) {
        const Lit lit = shine(plate(dx, jitter), beam_at(0, 0));
        EXPECT_NEAR(lit.power.hit, 150, 150e-3);
        EXPECT_NEAR(lit.power.absorbed, 0.35 * 150, 0.35 * 150e-3);
        const double top = lit.total([&](const Vector& p) { return p.z > -1.25 * dx; });
        EXPECT_GT(top, (jitter < 0.3 ? 0.999 : 0.98) * lit.power.absorbed) << jitter;
    }
}

TEST(LaserBeam, EachParticleOfALayerTakesTheFluxThroughItsCell)
{
    const double dx = 1e-5;
    const Lit lit = shine(plate(dx), beam_at(0, 0));
    const double square = widened_square(dx), peak = 0.35 * 2 * 150 / (std::numbers::pi * square);
    double worst = 0.0;
    for (Index i = 0; i < lit.scene.particles->count(); ++i) {
        const Vector p = lit.scene.particles->position[i];
        const double flux = peak * std::exp(-2 * (p.x * p.x + p.y * p.y) / square);
        if (p.z > -dx) worst = std::max(worst, std::abs(lit.heating(i) / (dx * dx) - flux) / peak);
    }
    EXPECT_LT(worst, 0.01); // cell average against its middle: dx²/24 · ∇²q
}

TEST(LaserBeam, IsAsMuchWiderAsRaysAndParticlesAreCoarse)
{
    // The variance of what a layer takes along an axis, in that of a spot of r₀ and in square spacings: 2 · 0.19.
    for (const double dx : {2e-5, 1e-5}) {
        const Lit lit = shine(plate(dx), beam_at(0, 0));
        double sum = 0.0, square = 0.0;
        for (Index i = 0; i < lit.scene.particles->count(); ++i) {
            const double x = lit.scene.particles->position[i].x;
            sum += lit.heating(i);
            square += lit.heating(i) * x * x;
        }
        EXPECT_NEAR((square / sum - 0.25 * spot_radius * spot_radius) / (dx * dx), 2 * 0.19, 0.02) << dx;
    }
}

TEST(LaserBeam, GrainAboveAPlateTakesItsLightAndShadesThePlate)
{
    const double dx = 1e-5, radius = 5e-5, height = 1e-4;
    Scene scene = lattice_scene(heat_case(plain_metal(), 3, dx), {-2.4e-4, -2.4e-4, -2 * dx}, {2.4e-4, 2.4e-4, 2e-4},
                                0.0, [&](const Vector& p) {
                                    const double above = p.z - height;
                                    return p.z < 0 || p.x * p.x + p.y * p.y + above * above < radius * radius;
                                });
    const Lit lit = shine(std::move(scene), beam_at(0, 0));
    const double grain = lit.total([](const Vector& p) { return p.z > 0; });
    const double reach = radius * radius;
    const double expected = 1 - std::exp(-2 * reach / widened_square(dx));
    // The grain's silhouette is a staircase of cells that discs of 0.75 spacings widen by a quarter of one.
    EXPECT_GT(grain / lit.power.absorbed, expected);
    EXPECT_LT(grain / lit.power.absorbed, expected * 1.10);
    EXPECT_NEAR(lit.power.hit, 150, 150e-3);
    const double shaded =
        lit.total([&](const Vector& p) { return p.z < 0 && p.x * p.x + p.y * p.y < 0.8 * 0.8 * reach; });
    EXPECT_EQ(shaded, 0.0);
    const double lower_half = lit.total([&](const Vector& p) { return p.z > 0 && p.z < height - dx; });
    EXPECT_LT(lower_half, 0.05 * grain);
}

TEST(LaserBeam, RaysThatMeetNothingAreLost)
{
    const double dx = 1e-5;
    Scene half_plate = lattice_scene(heat_case(plain_metal(), 3, dx), {0, -2.4e-4, -2 * dx}, {2.4e-4, 2.4e-4, 0});
    const Lit lit = shine(std::move(half_plate), beam_at(0, 0));
    EXPECT_GT(lit.power.hit, 75.0 - 1e-9);
    EXPECT_LT(lit.power.hit, 75.0 * 1.07); // the edge is widened by a quarter of a spacing, dx/4 √(2/π) 2/r₀ of 1
    EXPECT_NEAR(lit.power.absorbed, 0.35 * lit.power.hit, 1e-10);
    const Lit missed = shine(plate(dx, 0, 1e-4), beam_at(1e-3, 0));
    EXPECT_EQ(missed.power.hit, 0.0);
    EXPECT_EQ(missed.power.absorbed, 0.0);
    EXPECT_NEAR(missed.power.emitted, 150, 1e-9);
}

TEST(LaserBeam, GoesOnAndOffWithinAStepByItsShare)
{
    Laser laser = beam_at(-1e-4, 0);
    laser.to = {1e-4, 0};
    laser.speed = 1;
    laser.start = 1e-4; // off at 3e-4 s
    const auto emitted = [&](double time) { return shine(plate(4e-5), laser, time, 1e-4).power.emitted; };
    EXPECT_EQ(emitted(0), 0.0);
    EXPECT_NEAR(emitted(5e-5), 75, 1e-6);
    EXPECT_NEAR(emitted(1.5e-4), 150, 1e-6);
    EXPECT_NEAR(emitted(2.75e-4), 37.5, 1e-6);
    EXPECT_EQ(emitted(3.1e-4), 0.0);
}

TEST(LaserBeam, FollowsItsPath)
{
    Laser laser = beam_at(-1e-4, 2e-5);
    laser.to = {1e-4, 2e-5};
    laser.speed = 1;
    const Lit lit = shine(plate(1e-5), laser, 1.5e-4, 2e-5); // mean time 1.6e-4: x = 6e-5
    double x = 0.0, y = 0.0;
    for (Index i = 0; i < lit.scene.particles->count(); ++i) {
        x += lit.heating(i) * lit.scene.particles->position[i].x / lit.power.absorbed;
        y += lit.heating(i) * lit.scene.particles->position[i].y / lit.power.absorbed;
    }
    EXPECT_NEAR(x, 6e-5, 1e-6);
    EXPECT_NEAR(y, 2e-5, 1e-6);
}

TEST(LaserBeam, DoesNotDependOnTheOrderOfParticles)
{
    const Lit plain = shine(plate(2e-5, 0.3), beam_at(1e-6, 2e-6));
    Scene scene = plate(2e-5, 0.3);
    std::vector<Index> order(static_cast<std::size_t>(scene.particles->count()));
    for (std::size_t k = 0; k < order.size(); ++k)
        order[k] = static_cast<Index>(order.size() - 1 - k);
    scene.particles->permute(order);
    const Lit turned = shine(std::move(scene), beam_at(1e-6, 2e-6));
    for (Index i = 0; i < plain.scene.particles->count(); ++i)
        EXPECT_EQ(plain.heating(i), turned.heating(turned.scene.particles->place_of(i)));
}

TEST(LaserBeam, InTwoDimensionsIsItsMiddleSection)
{
    const double dx = 1e-5;
    const Lit lit =
        shine(lattice_scene(heat_case(plain_metal(), 2, dx), {-2.4e-4, 0, -4 * dx}, {2.4e-4, 0, 0}), beam_at(0, 0));
    const double section =
        2 * 150 / (std::numbers::pi * spot_radius * spot_radius) * std::sqrt(0.5 * std::numbers::pi) * spot_radius;
    EXPECT_NEAR(lit.power.emitted / section, 1, 1e-12);
    EXPECT_NEAR(lit.power.hit / section, 1, 1e-3);
}

} // namespace
} // namespace cupel::thermal_tests
