#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

/// The same in a liquid of the same properties.
Case in_an_equal_liquid(Case definition)
{
    definition.surrounding.emplace();
    definition.surrounding->material = "outside";
    definition.surrounding->resolved = true;
    definition.materials["outside"] = definition.materials.at("liquid");
    definition.materials.at("outside").name = "outside";
    return definition;
}

double kinetic_energy_of(const Particles& particles)
{
    return ordered_sum(particles.count(), [&](Index i) {
        const bool moves = particles.kind[static_cast<std::size_t>(i)] == Kind::fluid;
        return moves ? 0.5 * particles.mass[i] * dot(particles.velocity[i], particles.velocity[i]) : 0.0;
    });
}

class Wetting : public testing::TestWithParam<double>
{};
INSTANTIATE_TEST_SUITE_P(Angles, Wetting, testing::Values(105.0, 120.0, 150.0));

TEST_P(Wetting, WallsContinueAnOverhangAsItsCircle)
{
    // A drop that stands at the angle asked for: within the wall its surface goes on as the circle that it is. Colours
    // between 0 and 1 say how deep below it a wall particle lies, in spacings.
    const double angle = GetParam() * std::numbers::pi / 180.0, spacing = 0.05, radius = 0.5;
    Case definition = drop_on_a_wall(angle);
    const Vector center{1.0, 0.0, -radius * std::cos(angle)};
    definition.bodies.front().center = {center.x, center.y, center.z};
    Simulation simulation = simulate(definition, 1);
    const Particles& particles = simulation.particles();
    const ScalarField& colour = particles.scalar("colour");
    int seen = 0;
    double mean = 0.0, square = 0.0;
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = particles.position[i];
        const bool below = particles.kind[static_cast<std::size_t>(i)] == Kind::wall && p.z < 0.0;
        if (!below || colour[i] <= 0.0 || colour[i] >= 1.0) continue;
        const double off = (colour[i] - 0.5) - (radius - norm(p - center)) / spacing;
        mean += off;
        square += off * off;
        ++seen;
    }
    ASSERT_GE(seen, 4);
    // The lattice shows the edge to a part of a spacing, and each column of the wall sees it through its own kernel.
    EXPECT_LT(std::abs(mean / seen), 0.25);
    EXPECT_LT(std::sqrt(square / seen), 0.35);
}

TEST(Wetting, BooksCloseWhereWallsHoldTheEdgeOfADrop)
{
    // What pressure does to a particle that a wall holds is no compression's work.
    Case definition = drop_on_a_wall(std::numbers::pi / 9.0);
    definition.domain.lower = {-0.5, 0, 0};
    definition.domain.upper = {2.5, 0, 1};
    definition.numerics.reference_speed = 12.0; // no density is cut off
    definition.materials.at("liquid").viscosity = 0.03;
    Simulation simulation(place_particles(definition));
    simulation.start();
    while (simulation.time() < 0.5)
        simulation.step(0.5 - simulation.time());
    const MechanicalWork& work = simulation.flow()->books();
    const Ledger ledger = simulation.mechanical_ledger();
    EXPECT_EQ(work.limiter, 0.0);
    EXPECT_LT(work.stops, -0.001 * ledger.in);
    // Left without an answer, what pressure gave would be three quarters of that.
    EXPECT_LT(std::abs(ledger.end - ledger.start - ledger.in + ledger.out), 0.3 * std::abs(work.stops));
}

class TwoPhaseWetting : public testing::TestWithParam<double>
{};
INSTANTIATE_TEST_SUITE_P(Angles, TwoPhaseWetting, testing::Values(60.0, 75.0, 90.0, 105.0));

TEST_P(TwoPhaseWetting, WallsContinueAnInterfaceAsItsCircle)
{
    // The same between two liquids, by the normals, each with its weight: were they Young's in all three layers, they
    // would be off by what the circle turns below the wall.
    const double angle = GetParam() * std::numbers::pi / 180.0, radius = 0.5;
    Case definition = in_an_equal_liquid(drop_on_a_wall(angle));
    const Vector center{1.0, 0.0, -radius * std::cos(angle)};
    definition.bodies.front().center = {center.x, center.y, center.z};
    Simulation simulation = simulate(definition, 1);
    const Particles& particles = simulation.particles();
    const ScalarField& delta = particles.scalar("surface_delta");
    const VectorField& normal = particles.vector("surface_normal");
    double weight = 0.0, off = 0.0, flat = 0.0; // angles squared
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = particles.position[i];
        if (particles.kind[static_cast<std::size_t>(i)] != Kind::wall || p.z > 0.0 || !(delta[i] > 0.0)) continue;
        const Vector radial = p - center;
        const double exact = std::atan2(radial.z, std::abs(radial.x)), side = p.x > center.x ? 1.0 : -1.0;
        weight += delta[i];
        off += delta[i] * std::pow(std::atan2(normal[i].z, side * normal[i].x) - exact, 2);
        flat += delta[i] * std::pow(0.5 * std::numbers::pi - angle - exact, 2);
    }
    ASSERT_GT(weight, 0.0);
    EXPECT_LT(std::sqrt(off / weight), 0.4 * std::sqrt(flat / weight));
}

TEST(RoundWall, ShowsTheCircleOfADropThatStandsAtItsAngle)
{
    // In two phases, on a cylinder and in a vessel: what normals in the wall miss of the drop's circle is a part of
    // what the wall's own turn over the kernel's reach would make them miss.
    for (const bool inside : {false, true}) {
        const double radius = 0.5, wall = 1.0, angle = 0.5 * std::numbers::pi;
        Case definition = in_an_equal_liquid(drop_on_a_wall(angle));
        for (auto& boundary : definition.domain.boundaries)
            if (boundary) boundary->kind = BoundaryKind::open;
        definition.domain.lower = {-2.5, 0, -2.5};
        definition.domain.upper = {2.5, 0, 2.5};
        definition.domain.round_walls = RoundWalls{};
        if (inside)
            definition.domain.round_walls->outer_radius = wall;
        else {
            definition.domain.round_walls->inner_radius = wall;
            definition.domain.round_walls->outer_radius = 2.0;
        }
        // How far normals in the wall are from those of the drop's circle, root mean square over both its ends where it
        // lies at four places of the wall: at each of them the edge is known to a part of a spacing only.
        const auto off = [&](bool knows_its_curvature) {
            double weight = 0.0, square = 0.0;
            for (int place = 0; place < 4; ++place) {
                const double direction = place * 0.5 * std::numbers::pi + 0.1;
                // Circles that meet at right angles: the square of their centres' distance is the sum of theirs.
                const Vector center = std::hypot(radius, wall) * Vector{std::sin(direction), 0.0, std::cos(direction)};
                definition.bodies.front().center = {center.x, center.y, center.z};
                Simulation simulation(place_particles(definition));
                Particles& particles = simulation.particles();
                if (!knows_its_curvature) std::ranges::fill(particles.scalar("wall_curvature").values, 0.0);
                simulation.start();
                simulation.step(1.0);
                for (Index i = 0; i < particles.count(); ++i) {
                    const Vector arm = particles.position[i] - center;
                    const double delta = particles.scalar("surface_delta")[i];
                    if (particles.kind[static_cast<std::size_t>(i)] != Kind::wall || !(delta > 0.0)) continue;
                    const Vector miss = particles.vector("surface_normal")[i] - (1.0 / norm(arm)) * arm;
                    weight += delta;
                    square += delta * dot(miss, miss);
                }
            }
            return std::sqrt(square / weight);
        };
        const double with = off(true);
        EXPECT_LT(with, 0.1) << (inside ? "in a vessel" : "on a cylinder");
        EXPECT_LT(with, off(false)) << (inside ? "in a vessel" : "on a cylinder");
    }
}

TEST(DisorderedDrop, ComesToRest)
{
    // Particles a fifth of a spacing off their rings: below the first layer, where that is loose, normals are noise. As
    // a load on the surface they tore the drop apart, with 0.05 of the 2.5 J that its surface has.
    Case definition = drop_in_nothing();
    definition.numerics.position_jitter = 0.2;
    definition.numerics.shifting = 1.0;
    Simulation simulation(place_particles(definition));
    simulation.start();
    double greatest = 0.0;
    while (simulation.time() < 3.0) {
        simulation.step(3.0 - simulation.time());
        greatest = std::max(greatest, kinetic_energy_of(simulation.particles()));
    }
    EXPECT_GT(greatest, 1e-4);
    EXPECT_LT(kinetic_energy_of(simulation.particles()), 2e-3 * greatest);
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
