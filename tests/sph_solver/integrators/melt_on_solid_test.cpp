/// Melt on its own solid: one surface, that of the metal (models/metal_surface.hpp).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulated.hpp"

namespace cupel
{
namespace
{

using namespace small_scenes;

/// Half a disc of melt, radius 0.4, on a plate of its solid that goes on for ever; its temperature stays.
Case half_disc_on_its_solid()
{
    Case definition = pool(2, 0.05);
    definition.physics = {"flow", "surface_tension", "wetting", "heat", "melting"};
    Material& metal = definition.materials.at("liquid");
    metal.surface_tension = 1.0;
    metal.viscosity = 0.1;
    metal.contact_angle = 0.25 * std::numbers::pi; // of walls, which nothing here touches
    metal.specific_heat = metal.specific_heat_solid = 1000.0;
    metal.conductivity = metal.conductivity_solid = 1e-6;
    metal.solidus = 1690.0;
    metal.liquidus = 1710.0;
    metal.latent_heat = 1e5;
    definition.domain.lower = {0, 0, -0.3};
    definition.domain.upper = {2, 0, 0.7};
    definition.domain.boundaries[0]->kind = definition.domain.boundaries[1]->kind = BoundaryKind::periodic;
    Body melt = definition.bodies.front();
    melt.shape = BodyShape::sphere;
    melt.center = {1, 0, 0};
    melt.radius = 0.4;
    melt.temperature = 1800.0;
    Body plate = definition.bodies.front();
    plate.lower = {0, 0, -0.3};
    plate.upper = {2, 0, 0};
    plate.solid = true;
    plate.temperature = 1600.0;
    definition.bodies = {melt, plate};
    return definition;
}

/// Greatest distance of what is molten from the middle, along the plate.
double half_width(const Simulation& simulation)
{
    double furthest = 0.0;
    for (const Index i : simulation.neighbourhood().moving_particles())
        furthest = std::max(furthest, std::abs(simulation.particles().position[i].x - 1.0));
    return furthest;
}

TEST(MeltOnItsSolid, SpreadsAndGetsNoMoreThanItsSurfaceHas)
{
    Simulation simulation(place_particles(half_disc_on_its_solid()));
    simulation.start();
    const double start = half_width(simulation);
    const double capillary_time = std::sqrt(0.4 * 0.4 * 0.4);
    double fastest = 0.0;
    while (simulation.time() < 6.0 * capillary_time) {
        simulation.step(1.0);
        double energy = 0.0;
        for (const Index i : simulation.neighbourhood().moving_particles()) {
            const Vector v = simulation.particles().velocity[i];
            energy += 0.5 * simulation.particles().mass[i] * dot(v, v);
        }
        fastest = std::max(fastest, energy);
    }
    // Without solids in the surface it stops short of 1.2 of its half width. The film would be 0.126 deep from end to
    // end, for which its surface gives (π − 2) σR.
    EXPECT_GT(half_width(simulation), 1.5 * start);
    EXPECT_LT(fastest, 0.25 * (std::numbers::pi - 2.0) * 0.4);
}

TEST(MeltOnItsSolid, LevelWithItDoesNotMove)
{
    // A pool in a plate: the melt's surface goes on in that of its solid, and nothing pulls at the line between them.
    Case definition = half_disc_on_its_solid();
    Body& melt = definition.bodies.front();
    Body& plate = definition.bodies.back();
    melt.shape = BodyShape::box;
    melt.lower = {0.6, 0, -0.15};
    melt.upper = {1.4, 0, 0};
    std::swap(melt, plate);
    const Simulation simulation = simulate(definition, 200);
    const Particles& particles = simulation.particles();
    int solids_of_the_surface = 0;
    for (Index i = 0; i < particles.count(); ++i) {
        EXPECT_LT(norm(particles.velocity[i]), 2e-4); // of a capillary speed of 1.6
        const bool beside =
            particles.kind[static_cast<std::size_t>(i)] == Kind::solid && particles.scalar("surface_delta")[i] > 10.0;
        EXPECT_NEAR(particles.scalar("curvature")[i], 0.0, 0.01); // of the 20 of a spacing
        if (beside) ++solids_of_the_surface;
    }
    // Two on either side in the row at the top: within 2.9 spacings.
    EXPECT_EQ(solids_of_the_surface, 4);
}

TEST(MeltOnItsSolid, GoesOnFromACheckpointAsIfItHadNotStopped)
{
    const Case definition = half_disc_on_its_solid();
    Simulation unbroken = simulate(definition, 60);
    Simulation resumed = resume(unbroken, definition);
    for (int step = 0; step < 30; ++step) {
        unbroken.step(1.0);
        resumed.step(1.0);
    }
    ASSERT_EQ(unbroken.time(), resumed.time());
    for (Index i = 0; i < unbroken.particles().count(); ++i)
        EXPECT_EQ(norm(unbroken.particles().position[i] - resumed.particles().position[i]), 0.0);
}

} // namespace
} // namespace cupel
