#include "integrators/simulation.hpp"

#include <omp.h>

#include <numbers>

#include <gtest/gtest.h>

#include "simulated.hpp"

namespace cupel
{
namespace
{

using namespace small_scenes;

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

TEST(Simulation, MechanicalBooksHoldEveryWork)
{
    Case definition = heavy_pool();
    definition.numerics.artificial_viscosity = 0.05;
    const Simulation simulation = simulate(definition, 300);
    const MechanicalWork& work = simulation.flow()->books();
    const Ledger ledger = simulation.mechanical_ledger();
    EXPECT_GT(work.gravity, 0.0);
    EXPECT_LT(work.viscosity, 0.0);
    EXPECT_LT(work.artificial, 0.0);
    EXPECT_LT(work.density_diffusion, 0.0);
    // Every kick and every change of density has its causes, to round-off; what closes is that pressure gives what
    // compression takes, but for walls and for steps of finite length.
    const double all = ledger.in - ledger.out + work.pressure + work.compression - work.imbalance;
    EXPECT_NEAR(ledger.end - ledger.start, all, 1e-12 * ledger.in);
    EXPECT_LT(ledger.closure(), 2e-3);
}

TEST(Simulation, SettlingThenGoingOnEqualsLoadingThenGoingOn)
{
    Simulation unbroken = simulate(heavy_pool(), 60);
    Simulation resumed = resume(unbroken, heavy_pool());
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
    for (const char* field : {"temperature", "enthalpy", "curvature_of_nothing", "solid_colour", "transport_velocity"})
        EXPECT_FALSE(plain.particles().has(field)) << field;
    Case still = heavy_pool();
    still.numerics.shifting = 0.0;
    EXPECT_FALSE(simulate(still, 1).particles().has("surface_delta"));
}

/// A drop in a liquid of a thousandth of its density, between walls.
Case drop_in_a_light_liquid()
{
    Case definition = pool(2, 0.05);
    definition.physics = {"flow", "surface_tension"};
    definition.domain.boundaries[5]->kind = BoundaryKind::wall;
    Material& drop = definition.materials.at("liquid");
    drop.surface_tension = 1.0;
    Material outside = drop;
    outside.name = "outside";
    outside.density = 1e-3;
    outside.viscosity = 1e-3;
    definition.materials.emplace("outside", outside);
    definition.surrounding.emplace();
    definition.surrounding->material = "outside";
    definition.surrounding->resolved = true;
    Body& body = definition.bodies.front();
    body.shape = BodyShape::sphere;
    body.center = {1, 0, 0.75};
    body.radius = 0.4;
    return definition;
}

TEST(Simulation, SurfaceTensionDrivesALightPhaseAsTheHeavyOne)
{
    const Simulation simulation = simulate(drop_in_a_light_liquid(), 0);
    const Particles& particles = simulation.particles();
    const VectorField& acceleration = particles.vector("acceleration");
    double heavy = 0.0, light = 0.0; // root mean square, the same factor left out
    for (Index i = 0; i < particles.count(); ++i) {
        if (particles.scalar("surface_delta")[i] == 0.0) continue;
        const bool primary = particles.material[static_cast<std::size_t>(i)] == 0;
        (primary ? heavy : light) += dot(acceleration[i], acceleration[i]);
    }
    heavy = std::sqrt(heavy);
    light = std::sqrt(light);
    // What the load leaves on the two sides of the interface differs by little; were its gradient divided by each one's
    // own density, the light side's would be a thousand times the heavy side's.
    EXPECT_GT(heavy, 0.0);
    EXPECT_GT(light, 0.5 * heavy);
    EXPECT_LT(light, 2.0 * heavy);
}

TEST(Simulation, CornersOfABoxAreNoSurface)
{
    const Simulation simulation = simulate(drop_in_a_light_liquid(), 3);
    const Particles& particles = simulation.particles();
    for (Index i = 0; i < particles.count(); ++i)
        if (norm(particles.position[i] - Vector{1, 0, 0.75}) > 0.4 + 4.0 * 0.05) {
            EXPECT_EQ(particles.scalar("surface_delta")[i], 0.0)
                << particles.position[i].x << " " << particles.position[i].z;
        }
}

TEST(Simulation, ContinuumSurfaceForceIsTheLoadTimesDeltaAlongTheNormal)
{
    for (Case definition : {drop_in_nothing(), drop_in_a_light_liquid()}) {
        EXPECT_TRUE(simulate(definition, 0).particles().has("carried_load"));
        definition.numerics.surface_load = "continuum_force";
        const Simulation simulation = simulate(definition, 0);
        const Particles& particles = simulation.particles();
        EXPECT_FALSE(particles.has("carried_load"));
        const bool two_phase = definition.surrounding.has_value();
        double greatest = 0.0;
        for (Index i = 0; i < particles.count(); ++i) {
            const double delta = particles.scalar("surface_delta")[i];
            if (delta == 0.0) continue;
            const double load = 1.0 * particles.scalar("curvature")[i], density = two_phase ? 0.5005 : 1.0;
            const Vector expected = (-delta * load / density) * particles.vector("surface_normal")[i];
            const Vector pairs = (1.0 / particles.mass[i]) * particles.vector("force")[i];
            EXPECT_LT(norm(particles.vector("acceleration")[i] - pairs - expected), 1e-9 * (1.0 + norm(expected)));
            greatest = std::max(greatest, norm(expected));
        }
        EXPECT_GT(greatest, 10.0);
    }
}

/// For as long as sound takes to cross it some tens of times.
TEST(Simulation, DropInNothingHasItsLaplacePressureAndRests)
{
    const Simulation simulation = simulate(drop_in_nothing(), 600);
    const Particles& particles = simulation.particles();
    double pressure = 0.0, excess = 0.0, fastest = 0.0;
    Index inside = 0;
    for (const Index i : simulation.neighbourhood().moving_particles()) {
        fastest = std::max(fastest, norm(particles.velocity[i]));
        if (norm(particles.position[i] - Vector{1, 0, 0.5}) > 0.25) continue;
        pressure += particles.pressure[i];
        excess += particles.scalar("excess_pressure")[i];
        ++inside;
    }
    ASSERT_GT(inside, 60);
    EXPECT_NEAR(pressure / inside, 1.0 / 0.4, 0.001 / 0.4);
    // The load is carried inside, so that density has nearly nothing to bear.
    EXPECT_LT(std::abs(excess / inside), 0.05 / 0.4);
    EXPECT_LT(fastest, 0.05 * std::sqrt(1.0 / 0.4)); // of the capillary speed
}

TEST(Simulation, TwoPhasesStartFromTheirLatticeWithoutPressure)
{
    // What the kernel's sum over a lattice misses is 6e-5: as a pressure, that share of ρ c₀².
    Case definition = drop_in_a_light_liquid();
    definition.numerics.shifting = 0.0; // which starts a thousandth of a spacing off it
    const Simulation simulation = simulate(definition, 0);
    const Particles& particles = simulation.particles();
    const double sound_speed = simulation.flow()->parameters().equation_of_state.sound_speed;
    double greatest = 0.0;
    for (Index i = 0; i < particles.count(); ++i)
        greatest = std::max(greatest, std::abs(particles.scalar("excess_pressure")[i]));
    EXPECT_LT(greatest, 1e-9 * sound_speed * sound_speed);
}

TEST(Simulation, TwoPhasesAndTheirWallsTakeAndGiveBackButDoNotFeed)
{
    const Simulation simulation = simulate(drop_in_a_light_liquid(), 300);
    const MechanicalWork& work = simulation.flow()->books();
    EXPECT_GT(work.surface, 0.0);
    EXPECT_LT(work.viscosity, 0.0);
    // Walls hold what they are compressed by; the rest of what pressure gives compression has, to the small error of
    // steps of finite length.
    EXPECT_LT(std::abs(work.imbalance), 0.01 * work.surface);
    EXPECT_LT(simulation.mechanical_ledger().closure(), 1e-3);
}

TEST(PlaceParticles, LiquidThatIsShiftedStartsAThousandthOfASpacingOffItsLattice)
{
    const auto furthest_off = [](double shifting) {
        Case definition = pool();
        definition.numerics.shifting = shifting;
        const Scene scene = place_particles(definition);
        double furthest = 0.0;
        for (Index i = 0; i < scene.particles->count(); ++i) {
            const double cell = scene.particles->position[i].x / 0.1 - 0.5;
            furthest = std::max(furthest, std::abs(cell - std::round(cell)));
        }
        return furthest;
    };
    EXPECT_LT(furthest_off(0.0), 1e-12);
    EXPECT_GT(furthest_off(1.0), 1e-4);
    EXPECT_LT(furthest_off(1.0), 1.001e-3);
}

TEST(Simulation, SolidCoveredDomainHasNoWalls)
{
    Case definition = pool();
    definition.bodies.front().solid = true;
    const Scene scene = place_particles(definition);
    EXPECT_EQ(std::count(scene.particles->kind.begin(), scene.particles->kind.end(), Kind::wall), 0);
}

/// A channel of liquid that is driven along x between walls below and above, periodic along x.
Case channel()
{
    Case definition = pool();
    definition.physics = {"flow", "gravity"};
    definition.gravity = {1, 0, 0};
    definition.domain.upper = definition.bodies.front().upper = {1, 0, 1};
    definition.domain.boundaries[0]->kind = definition.domain.boundaries[1]->kind = BoundaryKind::periodic;
    definition.domain.boundaries[5]->kind = BoundaryKind::wall;
    // Nothing is shifted, so that particles start on the lattice and its rows stay.
    definition.numerics.shifting = 0.0;
    return definition;
}

TEST(Simulation, PeriodicChannelIsTheSameAllAlong)
{
    const Simulation simulation = simulate(channel(), 200);
    const Particles& particles = simulation.particles();
    // Rows start with ten particles each and stay alike: velocity depends on height alone, to round-off grown by 200
    // steps.
    std::map<Index, std::pair<double, double>> rows;
    for (const Index i : simulation.neighbourhood().moving_particles()) {
        const Index row = particles.identity[static_cast<std::size_t>(i)] / 10;
        const double u = particles.velocity[i].x;
        const auto [found, added] = rows.emplace(row, std::pair{u, u});
        found->second = {std::min(found->second.first, u), std::max(found->second.second, u)};
        EXPECT_GT(u, 0.0);
        EXPECT_GE(particles.position[i].x, -0.3);
        EXPECT_LE(particles.position[i].x, 1.3);
    }
    for (const auto& [row, range] : rows)
        EXPECT_NEAR(range.first, range.second, 1e-9) << row;
}

/// How far the particles of the right half of a heap that falls apart, beside a mirror, are from those of the whole
/// heap.
double difference_to_mirrored(double shifting, int steps)
{
    Case whole = pool();
    whole.physics = {"flow", "gravity"};
    whole.gravity = {0, 0, -1};
    whole.domain.lower = {-1, 0, 0};
    whole.domain.upper = {1, 0, 1.5};
    whole.bodies.front().lower = {-0.5, 0, 0};
    whole.bodies.front().upper = {0.5, 0, 1};
    whole.numerics.shifting = shifting;
    Case half = whole;
    half.domain.lower[0] = half.bodies.front().lower[0] = 0;
    half.domain.boundaries[0]->kind = BoundaryKind::symmetry;
    const auto run = [steps](const Case& definition) {
        Scene scene = place_particles(definition);
        // Back onto the lattice, so that both halves start alike.
        const auto centre = [](double& x) { x = 0.1 * (std::floor(x / 0.1) + 0.5); };
        for (double& x : scene.particles->position.x)
            centre(x);
        for (double& z : scene.particles->position.z)
            centre(z);
        Simulation simulation(std::move(scene));
        simulation.start();
        for (int step = 0; step < steps; ++step)
            simulation.step(1.0);
        return simulation;
    };
    const Simulation both = run(whole), right = run(half);
    EXPECT_DOUBLE_EQ(both.time(), right.time());
    double greatest = 0.0, fastest = 0.0;
    std::size_t count = 0;
    for (const Index i : right.neighbourhood().moving_particles()) {
        const Vector p = right.particles().position[i];
        double nearest = 1.0;
        for (const Index j : both.neighbourhood().moving_particles())
            nearest = std::min(nearest, norm(both.particles().position[j] - p));
        greatest = std::max(greatest, nearest);
        fastest = std::max(fastest, norm(right.particles().velocity[i]));
        ++count;
    }
    EXPECT_EQ(2 * count, both.neighbourhood().moving_particles().size());
    EXPECT_GT(fastest, 0.1);
    return greatest;
}

TEST(Simulation, MovingWallDragsTheLiquidAlongLinearly)
{
    Case definition = channel();
    definition.physics = {"flow"};
    definition.domain.boundaries[5]->velocity = {1, 0, 0};
    definition.numerics.shifting = 1.0;
    definition.materials.at("liquid").viscosity = 1.0;
    Simulation simulation(place_particles(definition));
    Particles& particles = simulation.particles();
    for (Index i = 0; i < particles.count(); ++i)
        if (particles.kind[static_cast<std::size_t>(i)] == Kind::fluid)
            particles.velocity.set(i, {particles.position[i].z, 0, 0});
    simulation.start();
    // Ten particles across, Reynolds number 1, ν t = 0.5 H²: long enough to find another profile, were there one.
    while (simulation.time() < 0.5)
        simulation.step(1.0);
    for (const Index i : simulation.neighbourhood().moving_particles())
        EXPECT_NEAR(particles.velocity[i].x, particles.position[i].z, 0.01);
}

TEST(Simulation, WallsOfPrescribedTemperatureHeatALiquidThatNeitherMeltsNorFlows)
{
    for (const BoundaryKind side : {BoundaryKind::periodic, BoundaryKind::symmetry}) {
        Case definition = channel();
        definition.spacing = 0.05;
        definition.physics = {"heat"};
        Material& liquid = definition.materials.at("liquid");
        liquid.specific_heat = liquid.specific_heat_solid = 1.0;
        liquid.conductivity = liquid.conductivity_solid = 0.01;
        definition.domain.boundaries[0]->kind = definition.domain.boundaries[1]->kind = side;
        definition.domain.boundaries[4]->temperature = 300.0;
        definition.domain.boundaries[5]->temperature = 400.0;
        Simulation simulation(place_particles(definition));
        simulation.start();
        const double time = 5.0; // α t = 0.05 H²
        while (simulation.time() < time * (1.0 - 1e-12))
            simulation.step(time - simulation.time());
        const Particles& particles = simulation.particles();
        for (Index i = 0; i < particles.count(); ++i) {
            if (particles.kind[static_cast<std::size_t>(i)] != Kind::fluid) continue;
            const double z = particles.position[i].z;
            double rise = z; // series for a plate whose upper face is suddenly 100 K hotter (Carslaw, Jaeger 1959, 3.4)
            for (int n = 1; n < 50; ++n) {
                const double k = n * std::numbers::pi;
                rise += 2.0 / k * (n % 2 ? -1.0 : 1.0) * std::sin(k * z) * std::exp(-k * k * 0.01 * time);
            }
            // Half a per cent of the wall's step at 20 particles across.
            EXPECT_NEAR(particles.scalar("temperature")[i], 300.0 + 100.0 * rise, 0.5);
        }
    }
}

TEST(Simulation, MirrorSideEqualsTheOtherHalf)
{
    EXPECT_LT(difference_to_mirrored(0.0, 100), 1e-12);
    // The colour gradient of clusters beside a wall is summed once more after the walls have theirs, with volumes a
    // step younger: which clusters those are depends on how particles are sorted, and shifting feels it a little. Later
    // (after step 30) that little decides whether one particle of the third layer is inside or of the surface's band.
    EXPECT_LT(difference_to_mirrored(1.0, 30), 1e-4 * 0.1);
}

} // namespace
} // namespace cupel
