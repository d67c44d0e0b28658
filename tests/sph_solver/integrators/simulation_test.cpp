#include "integrators/simulation.hpp"

#include <omp.h>

#include <gtest/gtest.h>

#include "small_scenes.hpp"

namespace cupel
{
namespace
{

using small_scenes::pool;

Simulation simulate(const Case& definition, int steps)
{
    Simulation simulation(place_particles(definition));
    simulation.start();
    for (int step = 0; step < steps; ++step)
        simulation.step(1.0);
    return simulation;
}

Case heavy_pool()
{
    Case definition = pool();
    definition.physics = {"flow", "gravity"};
    definition.gravity = {0.3, 0, -1};
    return definition;
}

double mass_of(const Particles& particles)
{
    return ordered_sum(particles.count(), [&](Index i) { return particles.mass[i]; });
}

TEST(Simulation, PoolAtRestStaysAtRest)
{
    Case definition = pool();
    definition.physics = {"flow", "gravity"};
    definition.gravity = {0, 0, -1};
    const Simulation simulation = simulate(definition, 300);
    double greatest = 0.0;
    for (const Index i : simulation.neighbourhood().moving_particles())
        greatest = std::max(greatest, norm(simulation.particles().velocity[i]));
    // 1 % of √(gH): what the rearrangement of the lattice under its own weight leaves.
    EXPECT_LT(greatest, 0.01 * std::sqrt(1.0));
}

TEST(Simulation, MassIsConservedToRoundOff)
{
    const Simulation start = simulate(heavy_pool(), 0);
    const Simulation end = simulate(heavy_pool(), 200);
    EXPECT_NEAR(mass_of(end.particles()), mass_of(start.particles()), 1e-12 * mass_of(start.particles()));
}

TEST(Simulation, SettlingThenGoingOnEqualsLoadingThenGoingOn)
{
    Simulation unbroken = simulate(heavy_pool(), 60);
    unbroken.settle();
    std::map<std::string, double> numbers;
    unbroken.save(numbers);

    Simulation resumed(place_particles(heavy_pool()));
    Particles& to = resumed.particles();
    const Particles& from = unbroken.particles();
    for (std::size_t k = 0; k < from.scalars().size(); ++k)
        to.scalars()[k]->values = from.scalars()[k]->values;
    for (std::size_t k = 0; k < from.vectors().size(); ++k) {
        to.vectors()[k]->x = from.vectors()[k]->x;
        to.vectors()[k]->y = from.vectors()[k]->y;
        to.vectors()[k]->z = from.vectors()[k]->z;
    }
    to.kind = from.kind;
    to.material = from.material;
    to.identity = from.identity;
    to.surface_parent = from.surface_parent;
    to.rebuild_places();
    resumed.load(numbers);
    resumed.settle();

    for (int step = 0; step < 60; ++step) {
        unbroken.step(1.0);
        resumed.step(1.0);
    }
    EXPECT_EQ(unbroken.time(), resumed.time());
    EXPECT_EQ(unbroken.particles().identity, resumed.particles().identity);
    EXPECT_EQ(unbroken.particles().position.x, resumed.particles().position.x);
    EXPECT_EQ(unbroken.particles().velocity.z, resumed.particles().velocity.z);
}

TEST(Simulation, NumberOfThreadsDoesNotChangeABit)
{
    omp_set_num_threads(1);
    const Simulation one = simulate(heavy_pool(), 40);
    omp_set_num_threads(3);
    const Simulation three = simulate(heavy_pool(), 40);
    EXPECT_EQ(one.particles().position.x, three.particles().position.x);
}

TEST(Simulation, ComputesOnlyWhatTheCaseNames)
{
    const Simulation plain = simulate(heavy_pool(), 1);
    for (const char* field : {"temperature", "enthalpy", "curvature_of_nothing", "solid_colour", "transport_force"})
        EXPECT_FALSE(plain.particles().has(field)) << field;
    Case still = heavy_pool();
    still.numerics.shifting = 0.0;
    EXPECT_FALSE(simulate(still, 1).particles().has("surface_delta"));
}

TEST(Simulation, SolidCoveredDomainHasNoWalls)
{
    Case definition = pool();
    definition.bodies.front().solid = true;
    const Scene scene = place_particles(definition);
    EXPECT_EQ(std::count(scene.particles->kind.begin(), scene.particles->kind.end(), Kind::wall), 0);
}

TEST(PlaceParticles, UnknownBoundaryIsRefused)
{
    Case definition = pool();
    definition.domain.boundaries[0]->kind = BoundaryKind::periodic;
    EXPECT_THROW(place_particles(definition), CaseError);
}

} // namespace
} // namespace cupel
