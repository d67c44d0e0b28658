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
    for_each_pair(neighbourhood.list(), particles, QuinticSpline(1.0, dimensions), neighbourhood.moving(),
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
    for_each_pair(neighbourhood.list(), particles, QuinticSpline(1.0, GetParam()), neighbourhood.moving(),
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

/// What has frozen keeps the value that it had as spray; it is part of a body now.
TEST(Cohesion, FrozenSprayHoldsNothing)
{
    Particles particles = small_scenes::jittered_lattice(6, 3, 0.3);
    ScalarField& mobility = particles.add_scalar({"mobility", "1"}, 1.0);
    ScalarField& unresolved = particles.add_scalar({"unresolved", "1"});
    VectorField& force = particles.add_vector({"force", "N"});
    Neighbourhood neighbourhood(3.0, 0.3, 1.0, 3);
    neighbourhood.rebuild(particles, mobility);
    const Index spray = particles.count() / 2;
    const auto greatest_force = [&](double moves) {
        unresolved[spray] = 1.0;
        mobility[spray] = moves;
        std::fill(force.x.begin(), force.x.end(), 0.0);
        for_each_pair(neighbourhood.list(), particles, QuinticSpline(1.0, 3), neighbourhood.all(),
                      Cohesion{{mobility},
                               1.0,
                               1.0,
                               Cohesion::bonds_across_a_plane(3),
                               {surface_tension, 0.0, 0.0, 0.0},
                               particles.kind,
                               nullptr,
                               unresolved,
                               force});
        double greatest = 0.0;
        for (Index i = 0; i < particles.count(); ++i)
            if (i != spray) greatest = std::max(greatest, std::abs(force[i].x));
        return greatest;
    };
    EXPECT_GT(greatest_force(1.0), 0.01);
    EXPECT_EQ(greatest_force(0.0), 0.0);
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
