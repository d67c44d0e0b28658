#include <gtest/gtest.h>

#include "integrators/simulation.hpp"
#include "models/cohesion.hpp"
#include "small_scenes.hpp"

namespace cupel
{
namespace
{

constexpr double surface_tension = 2.0;

/// A block of lattice spacing 1, all of it counted as unresolved, whose upper half is lifted by a gap: the force that
/// holds the halves together for each unit of area. Far from the block's edges it is the same for each site; the column
/// in the middle is such a one.
double pull(int dimensions, double gap)
{
    constexpr int n = 10;
    Particles particles = small_scenes::jittered_lattice(n, dimensions, 0.0);
    ScalarField& mobility = particles.add_scalar({"mobility", "1"});
    ScalarField& unresolved = particles.add_scalar({"unresolved", "1"});
    VectorField& force = particles.add_vector({"force", "N"});
    for (Index i = 0; i < particles.count(); ++i) {
        mobility[i] = unresolved[i] = 1.0;
        if (particles.position[i].z > 0.5 * n) particles.position.set(i, particles.position[i] + Vector{0.0, 0.0, gap});
    }
    Neighbourhood neighbourhood(3.0, 0.3, 1.0, dimensions);
    neighbourhood.rebuild(particles, mobility);
    for_each_pair(neighbourhood.list(), particles, RootFree(1.0, dimensions), neighbourhood.moving(),
                  Cohesion{{mobility},
                           1.0,
                           1.0,
                           Cohesion::bonds_across_a_plane(dimensions),
                           {surface_tension, 0.0, 0.0, 0.0},
                           particles.kind,
                           nullptr,
                           unresolved,
                           force});
    double sum = 0.0;
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = particles.position[i];
        const bool middle =
            std::abs(p.x - (0.5 * n + 0.5)) < 0.1 && (dimensions == 2 || std::abs(p.y - (0.5 * n + 0.5)) < 0.1);
        if (middle && p.z > 0.5 * n) sum -= force[i].z;
    }
    return sum;
}

class CohesionIn : public testing::TestWithParam<int>
{};
INSTANTIATE_TEST_SUITE_P(Dimensions, CohesionIn, testing::Values(2, 3));

/// The forces within the upper half cancel but for those of its own free surface, which do not depend on the gap.
TEST_P(CohesionIn, PullingALatticeApartTakesTwiceTheSurfaceTensionAnArea)
{
    const double apart = pull(GetParam(), 3.0);
    double work = 0.0;
    constexpr int steps = 60;
    constexpr double step = 3.0 / steps;
    for (int k = 0; k < steps; ++k)
        work += step * (pull(GetParam(), (k + 0.5) * step) - apart);
    EXPECT_NEAR(work, 2.0 * surface_tension, 2e-3 * surface_tension);
}

TEST_P(CohesionIn, PairForcesCancel)
{
    Particles particles = small_scenes::jittered_lattice(8, GetParam(), 0.3);
    ScalarField& mobility = particles.add_scalar({"mobility", "1"});
    ScalarField& unresolved = particles.add_scalar({"unresolved", "1"});
    ScalarField& temperature = particles.add_scalar({"temperature", "K"});
    VectorField& force = particles.add_vector({"force", "N"});
    for (Index i = 0; i < particles.count(); ++i) {
        mobility[i] = 1.0;
        unresolved[i] = 0.1 * static_cast<double>(i % 11);
        temperature[i] = 1700.0 + static_cast<double>(i % 7) * 50.0;
    }
    Neighbourhood neighbourhood(3.0, 0.3, 1.0, GetParam());
    neighbourhood.rebuild(particles, mobility);
    for_each_pair(neighbourhood.list(), particles, RootFree(1.0, GetParam()), neighbourhood.moving(),
                  Cohesion{{mobility},
                           1.0,
                           1.0,
                           Cohesion::bonds_across_a_plane(GetParam()),
                           {1.2, -4.3e-4, 1723.0, 0.1},
                           particles.kind,
                           &temperature,
                           unresolved,
                           force});
    Vector sum{};
    double greatest = 0.0;
    for (Index i = 0; i < particles.count(); ++i) {
        sum += force[i];
        greatest = std::max(greatest, norm(force[i]));
    }
    EXPECT_GT(greatest, 0.01);
    EXPECT_LT(norm(sum), 1e-12 * greatest * static_cast<double>(particles.count()));
}

/// Solids have the share of the surroundings that they have now: inside a block none, whatever they were as spray, and
/// all of it where they stand alone. Walls have none of their own.
TEST(Cohesion, SolidsAreAsThinAsTheyLook)
{
    Particles particles = small_scenes::jittered_lattice(9, 3, 0.0);
    ScalarField& mobility = particles.add_scalar({"mobility", "1"});
    ScalarField& unresolved = particles.add_scalar({"unresolved", "1"}, 1.0);
    const auto nearest_to = [&](const Vector& place) {
        Index nearest = 0;
        for (Index i = 0; i < particles.count(); ++i)
            if (norm(particles.position[i] - place) < norm(particles.position[nearest] - place)) nearest = i;
        return nearest;
    };
    const auto identity = [&](Index i) { return particles.identity[static_cast<std::size_t>(i)]; };
    const auto inside = identity(nearest_to({4.5, 4.5, 4.5})), alone = identity(nearest_to({0.5, 0.5, 0.5})),
               wall = identity(nearest_to({4.5, 4.5, 0.5}));
    for (Index i = 0; i < particles.count(); ++i) {
        mobility[i] = 0.0;
        unresolved[i] = 0.75;
        particles.kind[static_cast<std::size_t>(i)] = identity(i) == wall ? Kind::wall : Kind::solid;
        if (identity(i) == alone) particles.position.set(i, {-20.0, 0.0, 0.0});
    }
    Neighbourhood neighbourhood(3.0, 0.3, 1.0, 3);
    neighbourhood.rebuild(particles, mobility);
    for_each_pair(neighbourhood.list(), particles, RootFree(1.0, 3), neighbourhood.all(),
                  CompanionsOfSolids{{mobility}, 1.0, lattice_companions(3), particles.kind, unresolved});
    EXPECT_EQ(unresolved[particles.place_of(inside)], 0.0);
    EXPECT_EQ(unresolved[particles.place_of(alone)], 1.0);
    EXPECT_EQ(unresolved[particles.place_of(wall)], 0.75);
}

TEST(Cohesion, ActsOnSheetsAndSprayAndLeavesFlatSurfacesAlone)
{
    const double full = lattice_companions(3);
    EXPECT_EQ(Cohesion::share_unresolved(23.0, full), 0.0);
    EXPECT_EQ(Cohesion::share_unresolved(17.0, full), 0.0);
    EXPECT_EQ(Cohesion::share_unresolved(13.0, full), 1.0);
    EXPECT_EQ(Cohesion::share_unresolved(1.0, full), 1.0);
}

/// A particle thrown off a plate of its own metal at a Weber number ρu²Δx/σ of 0.25 stays.
TEST(Cohesion, ADropOfOneParticleDoesNotLeaveTheLiquidThatThrowsIt)
{
    Case definition = small_scenes::pool(2, 0.1);
    definition.physics = {"flow", "surface_tension"};
    definition.materials.at("liquid").surface_tension = 1.0;
    definition.materials.at("liquid").viscosity = 0.05;
    definition.domain.upper = {0.6, 0.0, 1.0};
    definition.bodies.front().upper = {0.6, 0.0, 0.3};
    Body thrown;
    thrown.material = "liquid";
    thrown.lower = {0.3, 0.0, 0.3};
    thrown.upper = {0.4, 0.0, 0.4};
    definition.bodies.push_back(thrown);
    Simulation simulation(place_particles(definition));
    Particles& particles = simulation.particles();
    const double speed = std::sqrt(0.25 * 1.0 / (1.0 * 0.1));
    Index drop = 0;
    for (Index i = 0; i < particles.count(); ++i)
        if (particles.kind[static_cast<std::size_t>(i)] == Kind::fluid &&
            particles.position[i].z > particles.position[drop].z)
            drop = i;
    const auto identity = particles.identity[static_cast<std::size_t>(drop)];
    particles.velocity.set(drop, {0.0, 0.0, speed});
    simulation.start();
    while (simulation.time() < 0.15)
        simulation.step(0.15 - simulation.time());
    double height = 0.0;
    for (Index i = 0; i < particles.count(); ++i)
        if (particles.identity[static_cast<std::size_t>(i)] == identity) height = particles.position[i].z;
    EXPECT_LT(height, 0.5); // unhindered it would be at 0.59
}

} // namespace
} // namespace cupel
