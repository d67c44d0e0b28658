#include <gtest/gtest.h>

#include <numbers>

#include "thermal/thermal_scene.hpp"

namespace cupel::thermal_tests
{
namespace
{

constexpr double length = 1e-4;

double slab_mode(double z, double time, double diffusivity)
{
    const double k = std::numbers::pi / length;
    return 1000.0 + 100.0 * std::cos(k * z) * std::exp(-diffusivity * k * k * time);
}

/// RMS error, relative to the amplitude of 100 K, of the mode cos(πz/L) between adiabatic ends after it has fallen to
/// about 1/e, on n particles.
double slab_error(int n, double jitter)
{
    const double dx = length / n;
    Scene scene = lattice_scene(heat_case(plain_metal(), 2, dx), {}, {8 * dx, 0, length}, jitter);
    ThermalStep step(scene);
    Particles& particles = *scene.particles;
    const double specific_heat = 780, diffusivity = 25.0 / (6900 * specific_heat);
    ScalarField& temperature = particles.scalar("temperature");
    for (Index i = 0; i < particles.count(); ++i) {
        temperature[i] = slab_mode(particles.position[i].z, 0.0, diffusivity);
        particles.scalar("enthalpy")[i] = specific_heat * temperature[i];
    }
    const NeighbourList list = neighbours(scene);
    const double end = length * length / (std::numbers::pi * std::numbers::pi * diffusivity);
    run(step, list, end);
    double sum = 0.0;
    for (Index i = 0; i < particles.count(); ++i)
        sum += std::pow(temperature[i] - slab_mode(particles.position[i].z, end, diffusivity), 2);
    return std::sqrt(sum / particles.count()) / 100.0;
}

TEST(Conduction, SlabModeDecaysAsItMustAndConverges)
{
    const double coarse = slab_error(10, 0.0), middle = slab_error(20, 0.0), fine = slab_error(40, 0.0);
    RecordProperty("error_10_20_40",
                   std::to_string(coarse) + " " + std::to_string(middle) + " " + std::to_string(fine));
    EXPECT_LT(middle, 0.005);
    EXPECT_LT(fine, 0.6 * middle);
    EXPECT_LT(middle, 0.6 * coarse);
}

TEST(Conduction, SlabModeSurvivesDisorder)
{
    EXPECT_LT(slab_error(20, 0.2), 0.01);
}

TEST(Conduction, IsotropicMediumAtRestStaysAtItsTemperature)
{
    Scene scene = lattice_scene(heat_case(plain_metal(), 3, 1e-5), {}, {8e-5, 8e-5, 8e-5}, 0.2);
    scene.definition.initial.temperature = 777;
    ThermalStep step(scene);
    const NeighbourList list = neighbours(scene);
    run(step, list, 50 * step.stable_time_step());
    const TemperatureRange range = step.temperature_range();
    EXPECT_TRUE(range.finite);
    EXPECT_DOUBLE_EQ(range.lowest, 777);
    EXPECT_DOUBLE_EQ(range.highest, 777);
}

TEST(Conduction, AlwaysLiesBetweenTheExtremesItBeganWith)
{
    Scene scene = lattice_scene(heat_case(plain_metal(), 3, 1e-5), {}, {8e-5, 8e-5, 8e-5}, 0.2);
    scene.definition.initial.temperature = 300;
    scene.definition.initial.temperature_gradient = {1e7, 0, 2e7};
    ThermalStep step(scene);
    const TemperatureRange before = step.temperature_range();
    const NeighbourList list = neighbours(scene);
    run(step, list, 50 * step.stable_time_step());
    const TemperatureRange after = step.temperature_range();
    EXPECT_GE(after.lowest, before.lowest);
    EXPECT_LE(after.highest, before.highest);
    EXPECT_LT(after.highest - after.lowest, before.highest - before.lowest);
}

TEST(Conduction, HeatIsConservedToRoundOff)
{
    Scene scene = lattice_scene(heat_case(steel(), 3, 1e-5, {"melting"}), {}, {8e-5, 8e-5, 8e-5}, 0.2);
    scene.definition.initial.temperature = 300;
    scene.definition.initial.temperature_gradient = {1e7, 1e7, 2e7}; // 300 to 3500 K: solid, mushy, liquid
    ThermalStep step(scene);
    const NeighbourList list = neighbours(scene);
    run(step, list, 100 * step.stable_time_step());
    EXPECT_LT(step.ledger().closure(), 1e-13);
}

/// One-dimensional start-up between an isothermal wall and an adiabatic end: first mode sin(πz/2L) of the deviation.
TEST(Conduction, WallOfPrescribedTemperatureHoldsIt)
{
    for (const double jitter : {0.0, 0.2}) {
        const double dx = length / 20;
        Case definition = heat_case(plain_metal(), 2, dx);
        definition.domain.upper = {8 * dx, 0, length};
        definition.domain.boundaries[std::size_t(Side::z_min)] = wall(500);
        Scene scene = lattice_scene(definition, {}, {8 * dx, 0, length}, jitter);
        ThermalStep step(scene);
        Particles& particles = *scene.particles;
        const double diffusivity = 25.0 / (6900 * 780.0), k = 0.5 * std::numbers::pi / length;
        ScalarField& temperature = particles.scalar("temperature");
        for (Index i = 0; i < particles.count(); ++i) {
            temperature[i] = 500 + 100 * std::sin(k * particles.position[i].z);
            particles.scalar("enthalpy")[i] = 780 * temperature[i];
        }
        const NeighbourList list = neighbours(scene);
        const double end = 1.0 / (k * k * diffusivity);
        run(step, list, end);
        double worst = 0.0;
        for (Index i = 0; i < particles.count(); ++i)
            worst = std::max(
                worst, std::abs(temperature[i] - 500 - 100 * std::exp(-1.0) * std::sin(k * particles.position[i].z)));
        RecordProperty(jitter > 0 ? "worst_K_jitter" : "worst_K", std::to_string(worst));
        EXPECT_LT(worst, jitter > 0 ? 1.0 : 0.3);
        EXPECT_LT(step.ledger().in, 1e-12 * step.ledger().out + 1e-30);
        EXPECT_GT(step.ledger().out, 0.0);
    }
}

TEST(Conduction, StepJustBelowTheLimitIsStableAndTheLimitIsSafe)
{
    Scene scene = lattice_scene(heat_case(plain_metal(), 3, 1e-5), {}, {8e-5, 8e-5, 8e-5}, 0.2);
    scene.definition.initial.temperature_gradient = {1e6, 0, 0};
    ThermalStep step(scene);
    EXPECT_NEAR(step.stable_time_step(), 0.075 * 1e-10 / (25.0 / (6900 * 780.0)), 1e-12);
    const TemperatureRange before = step.temperature_range();
    const NeighbourList list = neighbours(scene);
    for (int n = 0; n < 300; ++n)
        step.advance(list, 0, 2.4 * step.stable_time_step());
    const TemperatureRange after = step.temperature_range();
    EXPECT_LE(after.highest, before.highest);
    EXPECT_GE(after.lowest, before.lowest);
}

} // namespace
} // namespace cupel::thermal_tests
