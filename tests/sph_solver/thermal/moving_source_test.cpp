#include <gtest/gtest.h>

#include <numbers>

#include "thermal/thermal_scene.hpp"

namespace cupel::thermal_tests
{
namespace
{

constexpr double density = 6900, specific_heat = 780, conductivity = 25, absorptivity = 0.35;
constexpr double spot_radius = 8e-5, speed = 0.15, power = 150, initial = 300, isotherm = 1723;
constexpr double diffusivity = conductivity / (density * specific_heat);

/// Temperature of a half space z < 0 a time `duration` after a Gaussian beam was switched on, x measured from the beam
/// along its way (Cline and Anthony 1977):
///
///   T − T₀ = (AP/ρc) ∫₀^t (παs)^(−1/2) e^{−z²/4αs} exp{−[(x+vs)²+y²]/[2(a²+2αs)]} / [2π(a²+2αs)] ds,   a = r₀/2
double exact_temperature(double x, double y, double z, double duration)
{
    // s = w² takes the root away; Simpson's rule in w.
    constexpr int intervals = 800;
    const double end = std::sqrt(duration), a_squared = 0.25 * spot_radius * spot_radius;
    double sum = 0.0;
    for (int n = 0; n <= intervals; ++n) {
        const double w = end * n / intervals, s = w * w;
        const double width = a_squared + 2 * diffusivity * s;
        const double depth = s > 0 ? std::exp(-z * z / (4 * diffusivity * s)) : (z == 0 ? 1.0 : 0.0);
        const double along = x + speed * s;
        const double value = 2.0 / std::sqrt(std::numbers::pi * diffusivity) * depth *
                             std::exp(-(along * along + y * y) / (2 * width)) / (2 * std::numbers::pi * width);
        sum += value * (n == 0 || n == intervals ? 1 : n % 2 ? 4 : 2);
    }
    return initial + absorptivity * power / (density * specific_heat) * sum * end / intervals / 3.0;
}

struct Pool
{
    double half_width = 0; ///< of the isotherm on the plane `surface`, m
    double depth = 0;      ///< of the isotherm, m
};

/// Greatest distance from the axis and greatest depth of the isotherm, by bisection of an analytic field; the width on
/// the plane z = `surface`.
Pool exact_pool(double surface, double duration)
{
    const auto reach = [&](const auto& temperature_at) {
        double greatest = 0.0;
        for (double x = -1.5e-4; x < 1e-4; x += 4e-6) {
            double low = 0.0, high = 4e-4;
            if (temperature_at(x, low) < isotherm) continue;
            for (int n = 0; n < 25; ++n)
                (temperature_at(x, 0.5 * (low + high)) > isotherm ? low : high) = 0.5 * (low + high);
            greatest = std::max(greatest, low);
        }
        return greatest;
    };
    return {reach([&](double x, double y) { return exact_temperature(x, y, surface, duration); }),
            reach([&](double x, double z) { return exact_temperature(x, 0, -z, duration); })};
}

struct Outcome
{
    Pool pool;
    double laser_error, closure, rms; ///< rms of T where T > 600 K below the outermost layer, over the greatest rise
};

Outcome moving_source(double dx, double duration)
{
    Case definition = heat_case(plain_metal(), 3, dx, {"laser"});
    const double begin = 2e-4, half = 2.4e-4, deep = 2e-4;
    const double from = begin, at_end = begin + speed * duration, far = at_end + 2e-4;
    Laser laser;
    laser.power = power;
    laser.speed = speed;
    laser.spot_radius = spot_radius;
    laser.absorptivity = absorptivity;
    laser.from = {from, 0};
    laser.to = {from + 1, 0};
    definition.laser = laser;
    definition.domain.lower = {0, -half, -deep};
    definition.domain.upper = {far, half, deep};
    for (const Side side : {Side::x_min, Side::x_max, Side::y_min, Side::y_max, Side::z_min})
        definition.domain.boundaries[std::size_t(side)] = wall(initial);
    definition.initial.temperature = initial;
    Scene scene = lattice_scene(definition, {0, -half, -deep}, {far, half, 0});
    ThermalStep step(scene);
    const NeighbourList list = neighbours(scene);
    run(step, list, duration);

    Outcome result{{}, step.laser_absorption_error(), step.ledger().closure(), 0};
    const Particles& particles = *scene.particles;
    const ScalarField& temperature = particles.scalar("temperature");
    // On the lattice the isotherm is found by linear interpolation between neighbours across and down.
    double sum = 0.0, greatest = 0.0;
    int count = 0;
    std::map<std::array<int, 3>, double> field;
    for (Index i = 0; i < particles.count(); ++i) {
        const Vector p = particles.position[i];
        field[{int(std::floor(p.x / dx)), int(std::floor(p.y / dx)), int(std::floor(p.z / dx))}] = temperature[i];
        const double exact = exact_temperature(p.x - at_end, p.y, p.z, duration);
        greatest = std::max(greatest, exact - initial);
        if (exact > 600 && p.z < -dx) {
            sum += std::pow(temperature[i] - exact, 2);
            ++count;
        }
    }
    result.rms = std::sqrt(sum / count) / greatest;
    for (const auto& [cell, hot] : field) {
        const auto crossing = [&](std::array<int, 3> next) {
            const auto found = field.find(next);
            return found != field.end() && hot > isotherm && found->second <= isotherm
                       ? (hot - isotherm) / (hot - found->second)
                       : -1.0;
        };
        if (const double part = crossing({cell[0], cell[1] + 1, cell[2]}); part >= 0 && cell[2] == -1)
            result.pool.half_width = std::max(result.pool.half_width, (cell[1] + 0.5 + part) * dx);
        if (const double part = crossing({cell[0], cell[1], cell[2] - 1}); part >= 0 && cell[1] == 0)
            result.pool.depth = std::max(result.pool.depth, (-cell[2] - 0.5 + part) * dx);
    }
    return result;
}

TEST(MovingSource, SteadyPoolIsThatOfTheTable)
{
    const Pool pool = exact_pool(0.0, 0.05);
    EXPECT_NEAR(2e6 * pool.half_width, 204.7, 0.3);
    EXPECT_NEAR(1e6 * pool.depth, 79.5, 0.3);
}

TEST(MovingSource, PoolIsThatOfTheExactSolution)
{
    const double dx = 2e-5, duration = 1e-3;
    const Outcome result = moving_source(dx, duration);
    const Pool exact = exact_pool(-0.5 * dx, duration);
    const double width = result.pool.half_width / exact.half_width - 1, depth = result.pool.depth / exact.depth - 1;
    RecordProperty("width_error", std::to_string(width));
    RecordProperty("depth_error", std::to_string(depth));
    RecordProperty("rms", std::to_string(result.rms));
    EXPECT_LT(std::abs(width), 0.01);
    EXPECT_LT(std::abs(depth), 0.01);
    EXPECT_LT(result.rms, 0.005);
    EXPECT_LT(result.laser_error, 1e-12);
    EXPECT_LT(result.closure, 1e-10);
}

} // namespace
} // namespace cupel::thermal_tests
