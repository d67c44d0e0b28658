#include <gtest/gtest.h>

#include "thermal/thermal_scene.hpp"

namespace cupel::thermal_tests
{
namespace
{

/// A small track with all that heat can do: laser, melting, evaporation, radiation, a wall of prescribed temperature.
Case track_case(double dx, std::vector<std::string> physics)
{
    Case definition = heat_case(steel(), 3, dx, std::move(physics));
    Laser laser;
    laser.power = 200;
    laser.speed = 0.5;
    laser.spot_radius = 4e-5;
    laser.absorptivity = 0.35;
    laser.from = {8e-5, 0};
    laser.to = {2.2e-4, 0};
    definition.laser = laser;
    Surrounding surrounding;
    surrounding.temperature = 300;
    surrounding.convection_coefficient = 80;
    definition.surrounding = surrounding;
    definition.initial.temperature = 300;
    definition.domain.lower = {0, -1.2e-4, -1e-4};
    definition.domain.upper = {3e-4, 1.2e-4, 1e-4};
    for (const Side side : {Side::x_min, Side::x_max, Side::y_min, Side::y_max})
        definition.domain.boundaries[std::size_t(side)] = wall();
    definition.domain.boundaries[std::size_t(Side::z_min)] = wall(300);
    return definition;
}

Scene track_scene(double dx, std::vector<std::string> physics)
{
    const Case definition = track_case(dx, std::move(physics));
    return lattice_scene(definition, {0, -1.2e-4, -1e-4}, {3e-4, 1.2e-4, 0}, 0.1);
}

const std::vector<std::string> everything{"laser", "melting", "evaporation", "radiation"};

TEST(ThermalStep, EnergyLedgerClosesWithEverythingOn)
{
    Scene scene = track_scene(2e-5, everything);
    ThermalStep step(scene);
    const NeighbourList list = neighbours(scene);
    run(step, list, 4e-4);
    const HeatBooks& books = step.books();
    EXPECT_NEAR(books.laser_emitted, 200 * 2.8e-4, 1e-9); // off after 0.14 mm at 0.5 m/s
    EXPECT_GT(books.laser_hit, 0.999 * books.laser_emitted);
    EXPECT_LT(step.laser_absorption_error(), 1e-12);
    EXPECT_GT(books.evaporation, 0.0);
    EXPECT_GT(books.radiation, 0.0);
    EXPECT_GT(books.convection, 0.0);
    EXPECT_GT(books.walls_out, 0.0);
    RecordProperty("closure", std::to_string(step.ledger().closure() * 1e12) + "e-12");
    EXPECT_LT(step.ledger().closure(), 1e-10);
    for (Index i = 0; i < scene.particles->count(); ++i)
        EXPECT_GE(scene.particles->scalar("peak_temperature")[i], scene.particles->scalar("temperature")[i]);
    EXPECT_GE(step.temperature_range().lowest, step.lowest_possible_temperature() - 1e-9);
}

TEST(ThermalStep, EvaporationHoldsTheSurfaceBelowWhatItWouldReach)
{
    const auto greatest_peak = [](const std::vector<std::string>& physics) {
        Scene scene = track_scene(2e-5, physics);
        ThermalStep step(scene);
        const NeighbourList list = neighbours(scene);
        run(step, list, 2e-4);
        double greatest = 0.0;
        for (Index i = 0; i < scene.particles->count(); ++i)
            greatest = std::max(greatest, scene.particles->scalar("peak_temperature")[i]);
        return greatest;
    };
    const double without = greatest_peak({"laser", "melting"}), with = greatest_peak(everything);
    EXPECT_GT(without, 6000.0);
    EXPECT_LT(with, 5000.0);
    EXPECT_GT(with, 3050.0);
}

TEST(ThermalStep, LedgerNoticesHeatThatNobodyBooked)
{
    Scene scene = track_scene(2e-5, everything);
    ThermalStep step(scene);
    const NeighbourList list = neighbours(scene);
    run(step, list, 1e-4);
    for (Index i = 0; i < 20; ++i)
        scene.particles->scalar("enthalpy")[i] += 1e5;
    EXPECT_GT(step.ledger().closure(), 1e-3);
}

TEST(ThermalStep, RegistersOnlyWhatTheCaseNames)
{
    Scene plain = track_scene(2e-5, {});
    ThermalStep plain_step(plain);
    for (const char* name :
         {"liquid_fraction", "metal", "exposed_area", "velocity_divergence", "artificial_conductivity"})
        EXPECT_FALSE(plain.particles->has(name)) << name;
    Scene full = track_scene(2e-5, everything);
    ThermalStep full_step(full);
    for (const char* name : {"temperature", "enthalpy", "peak_temperature", "liquid_fraction", "exposed_area"})
        EXPECT_TRUE(full.particles->has(name)) << name;
    EXPECT_EQ(full.particles->scalar("temperature").info.output, Output::yes);
    EXPECT_EQ(full.particles->scalar("peak_temperature").info.output, Output::yes);
    EXPECT_EQ(full.particles->scalar("liquid_fraction").info.output, Output::yes);
}

TEST(ThermalStep, WhatLossesNeedIsNamedWhereItIsMissing)
{
    Scene no_surrounding = track_scene(2e-5, {"radiation"});
    no_surrounding.definition.surrounding.reset();
    EXPECT_THROW(ThermalStep{no_surrounding}, CaseError);
    Scene no_heat_of_vaporization = track_scene(2e-5, {"evaporation"});
    no_heat_of_vaporization.materials.front().vaporization_heat.reset();
    EXPECT_THROW(ThermalStep{no_heat_of_vaporization}, CaseError);
    Scene no_laser = track_scene(2e-5, {"laser"});
    no_laser.definition.laser.reset();
    EXPECT_THROW(ThermalStep{no_laser}, CaseError);
}

TEST(ThermalStep, GoesOnFromACheckpointBitForBit)
{
    const double time_step = 5e-6;
    Scene unbroken = track_scene(2e-5, everything);
    ThermalStep step(unbroken);
    const NeighbourList list = neighbours(unbroken);
    for (int n = 0; n < 10; ++n)
        step.advance(list, n * time_step, time_step);

    Scene resumed = track_scene(2e-5, everything);
    ThermalStep resumed_step(resumed);
    const NeighbourList resumed_list = neighbours(resumed);
    for (std::size_t k = 0; k < unbroken.particles->scalars().size(); ++k)
        resumed.particles->scalars()[k]->values = unbroken.particles->scalars()[k]->values;
    std::map<std::string, double> numbers;
    step.save(numbers);
    resumed_step.load(numbers);
    EXPECT_EQ(resumed_step.ledger().closure(), step.ledger().closure());

    for (int n = 10; n < 20; ++n) {
        step.advance(list, n * time_step, time_step);
        resumed_step.advance(resumed_list, n * time_step, time_step);
    }
    for (Index i = 0; i < unbroken.particles->count(); ++i)
        EXPECT_EQ(unbroken.particles->scalar("enthalpy")[i], resumed.particles->scalar("enthalpy")[i]);
    EXPECT_EQ(step.books().laser_absorbed, resumed_step.books().laser_absorbed);
    numbers.erase("heat.laser_hit");
    EXPECT_THROW(resumed_step.load(numbers), std::out_of_range);
}

TEST(ThermalStep, DoesNotDependOnTheNumberOfThreads)
{
    const auto enthalpies = [](int threads) {
        Scene scene = track_scene(1.25e-5, everything);
        ThermalStep step(scene);
        const NeighbourList list = neighbours(scene);
        omp_set_num_threads(threads);
        for (int n = 0; n < 5; ++n)
            step.advance(list, n * 2e-6, 2e-6);
        std::vector<double> result(scene.particles->scalar("enthalpy").values.begin(),
                                   scene.particles->scalar("enthalpy").values.end());
        result.push_back(step.ledger().end);
        result.push_back(step.books().walls_out);
        result.push_back(step.books().radiation);
        return result;
    };
    EXPECT_EQ(enthalpies(1), enthalpies(3));
}

TEST(ThermalStep, NotANumberIsFound)
{
    Scene scene = track_scene(2e-5, {});
    ThermalStep step(scene);
    EXPECT_TRUE(step.temperature_range().finite);
    scene.particles->scalar("temperature")[7] = std::nan("");
    EXPECT_FALSE(step.temperature_range().finite);
    EXPECT_EQ(step.temperature_range().hottest, 7);
}

TEST(ThermalStep, WallParticlesTakeNoPartAndHaveTheirWallsTemperature)
{
    Case definition = track_case(2e-5, {});
    Scene scene = lattice_scene(definition, {0, -1.2e-4, -1.6e-4}, {3e-4, 1.2e-4, 0});
    Particles& particles = *scene.particles;
    for (Index i = 0; i < particles.count(); ++i)
        if (particles.position[i].z < -1e-4) particles.kind[static_cast<std::size_t>(i)] = Kind::wall;
    scene.definition.initial.temperature = 1000;
    ThermalStep step(scene);
    const NeighbourList list = neighbours(scene);
    run(step, list, 2e-4);
    for (Index i = 0; i < particles.count(); ++i)
        if (particles.kind[static_cast<std::size_t>(i)] == Kind::wall) {
            EXPECT_EQ(particles.scalar("temperature")[i], 300.0);
            EXPECT_EQ(particles.scalar("heating_power")[i], 0.0);
        }
    EXPECT_GT(step.books().walls_out, 0.0);
    EXPECT_LT(step.ledger().closure(), 1e-10);
}

TEST(ThermalStep, SumsOfPlacesFollowParticlesThatMove)
{
    Scene scene = track_scene(2e-5, {"radiation"});
    ThermalStep step(scene);
    Particles& particles = *scene.particles;
    NeighbourList list = neighbours(scene);
    step.advance(list, 0, 1e-9);
    // The upper half lifts off by four spacings: a new surface opens.
    for (Index i = 0; i < particles.count(); ++i)
        if (const Vector p = particles.position[i]; p.z > -6e-5) {
            particles.position.set(i, {p.x, p.y, p.z + 8e-5});
            step.mark_moved(i);
        }
    list.build(particles);
    step.advance(list, 1e-9, 1e-9);
    const auto mean_below_the_gap = [&] {
        double sum = 0.0;
        int count = 0;
        for (Index i = 0; i < particles.count(); ++i)
            if (particles.position[i].z > 0 && particles.position[i].z < 4e-5) {
                sum += particles.scalar("exposed_area")[i];
                ++count;
            }
        return sum / count;
    };
    EXPECT_GT(mean_below_the_gap(), 0.5 * 4e-10);
}

TEST(ArtificialHeat, MovesHeatWithoutMakingAnyAndOnlyWhereTheFlowDiverges)
{
    const auto advanced = [](double strength, double divergence) {
        Scene scene = lattice_scene(heat_case(plain_metal(), 3, 1e-5), {}, {1e-4, 1e-4, 1e-4}, 0.2);
        scene.definition.numerics.artificial_heat = strength;
        scene.definition.initial.temperature = 300;
        scene.definition.initial.temperature_gradient = {1e7, 0, 0};
        ThermalStep step(scene);
        Particles& particles = *scene.particles;
        for (Index i = 0; i < particles.count(); ++i)
            particles.velocity.set(i, {-divergence * particles.position[i].x, 5, 0});
        const NeighbourList list = neighbours(scene);
        for (int n = 0; n < 20; ++n)
            step.advance(list, 0, 1e-7);
        EXPECT_LT(step.ledger().closure(), 1e-13);
        return step.temperature_range().highest - step.temperature_range().lowest;
    };
    const double without = advanced(0.0, 1e5), at_rest = advanced(1.0, 0.0), with = advanced(1.0, 1e5);
    EXPECT_NEAR(at_rest, without, 1e-9 * without);
    EXPECT_LT(with, 0.995 * without);
}

TEST(ArtificialHeat, HasTheConductivityOfItsFormula)
{
    const ArtificialConductivity conductivity{0.1, 0.2, 1e-5, 50};
    // 7000 · 1e-10 · 1e4 · (0.1 + 0.2 · 1e-5 · 1e4/50) · 780
    EXPECT_NEAR(conductivity(-1e4, 7000, 780), 7000 * 1e-10 * 1e4 * 0.1004 * 780, 1e-10);
    EXPECT_EQ(conductivity(0, 7000, 780), 0);
}

} // namespace
} // namespace cupel::thermal_tests
