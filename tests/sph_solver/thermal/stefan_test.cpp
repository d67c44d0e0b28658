#include <gtest/gtest.h>

#include <numbers>

#include "thermal/thermal_scene.hpp"

namespace cupel::thermal_tests
{
namespace
{

constexpr double depth = 1e-4; // of the front at the end, m

/// β of the one-phase problem: β e^{β²} erf β = St/√π.
double stefan_beta(double stefan)
{
    double low = 1e-3, high = 3.0;
    for (int n = 0; n < 100; ++n) {
        const double beta = 0.5 * (low + high);
        (beta * std::exp(beta * beta) * std::erf(beta) < stefan / std::sqrt(std::numbers::pi) ? low : high) = beta;
    }
    return low;
}

/// Relative error of the melted depth, 304L's liquid data, wall at T_m + excess, n particles across the depth.
double front_error(int n, double excess, double jitter)
{
    const double dx = depth / n, melting_point = 1723;
    Material metal = plain_metal();
    metal.conductivity = 18.1;
    metal.solidus = metal.liquidus = melting_point;
    metal.latent_heat = 247000;
    Case definition = heat_case(metal, 2, dx, {"melting"});
    const int across = 8, along = static_cast<int>(1.6 * n);
    definition.domain.upper = {across * dx, 0, along * dx};
    definition.domain.boundaries[std::size_t(Side::z_min)] = wall(melting_point + excess);
    definition.initial.temperature = melting_point;
    Scene scene = lattice_scene(definition, {}, {across * dx, 0, along * dx}, jitter);
    ThermalStep step(scene);
    const NeighbourList list = neighbours(scene);
    const double beta = stefan_beta(780 * excess / 247000), diffusivity = 18.1 / (6900 * 780.0);
    run(step, list, depth * depth / (4 * beta * beta * diffusivity));
    EXPECT_LT(step.ledger().closure(), 1e-12);
    double melted = 0.0;
    for (Index i = 0; i < scene.particles->count(); ++i)
        melted += scene.particles->scalar("liquid_fraction")[i] * dx / across;
    return melted / depth - 1.0;
}

TEST(Stefan, ConstantsOfTheExactSolutionAreThoseOfTheTable)
{
    EXPECT_NEAR(stefan_beta(780 * 100 / 247000.0), 0.37864, 5e-6);
    EXPECT_NEAR(stefan_beta(780 * 300 / 247000.0), 0.60693, 5e-6);
    EXPECT_NEAR(stefan_beta(780 * 1000 / 247000.0), 0.92830, 5e-6);
}

TEST(Stefan, FrontIsWithinThreePerMilleAtTwentyParticles)
{
    for (const double excess : {100.0, 300.0, 1000.0}) {
        const double error = front_error(20, excess, 0.0);
        RecordProperty("error_at_" + std::to_string(int(excess)) + "_K", std::to_string(error));
        EXPECT_LT(std::abs(error), 0.003) << excess;
    }
}

TEST(Stefan, FrontIsWithinFivePerMilleAtTwentyParticlesWithTwentyPercentJitter)
{
    const double error = front_error(20, 300, 0.2);
    RecordProperty("error", std::to_string(error));
    EXPECT_LT(std::abs(error), 0.005);
}

TEST(Stefan, FrontConverges)
{
    const double coarse = front_error(10, 300, 0.0), fine = front_error(40, 300, 0.0);
    RecordProperty("error_10", std::to_string(coarse));
    RecordProperty("error_40", std::to_string(fine));
    EXPECT_LT(std::abs(fine), 0.5 * std::abs(coarse));
}

} // namespace
} // namespace cupel::thermal_tests
