#include <gtest/gtest.h>

#include <numbers>

#include "models/carman_kozeny.hpp"
#include "models/recoil_pressure.hpp"
#include "models/surface_losses.hpp"
#include "thermal/thermal_scene.hpp"

namespace cupel::thermal_tests
{
namespace
{

constexpr VapourPressure steel_vapour{101325, 3050, 6.1e6, 0.0558};

TEST(RecoilPressure, IsAnisimovsAtTheBoilingPointAndAtFourThousandKelvin)
{
    EXPECT_NEAR(recoil_pressure(steel_vapour, 3050), 0.54 * 101325, 1e-6);
    // L_v M/R = 40 938.3 K; 1/3050 − 1/4000 = 7.786885e-5 1/K; exp(3.187818) = 24.23551
    EXPECT_NEAR(recoil_pressure(steel_vapour, 4000), 0.54 * 101325 * 24.23551, 1);
    EXPECT_GT(recoil_pressure(steel_vapour, 3200), recoil_pressure(steel_vapour, 3100));
}

TEST(Evaporation, HasItsValuesByHand)
{
    const Evaporation evaporation{steel_vapour};
    // 0.82 · 6.1e6 · 101 325 · √(0.0558/(2π · 8.314463 · 3050)) = 5.06828e11 · 5.91776e-4
    EXPECT_NEAR(evaporation.heat_flux(3050), 2.99929e8, 2e4);
    // at 4000 K: 0.82 · 6.1e6 · 2.455703e6 · 5.16743e-4
    EXPECT_NEAR(evaporation.heat_flux(4000), 6.3474e9, 1e6);
    EXPECT_LT(evaporation.heat_flux(300), 1e-30);
    EXPECT_TRUE(std::isfinite(evaporation.heat_flux(0.0)));
}

TEST(Radiation, HasItsValuesByHand)
{
    const Radiation radiation{0.6, 80, 300};
    // 0.6 · 5.670374e-8 · (1.6e13 − 8.1e9)
    EXPECT_NEAR(radiation.radiative_flux(2000), 544080.3, 1);
    EXPECT_NEAR(radiation.convective_flux(2000), 136000, 1e-6);
    EXPECT_EQ(radiation.radiative_flux(300), 0);
    EXPECT_LT(radiation.radiative_flux(200), 0);
}

TEST(CarmanKozeny, StopsSolidAndLeavesLiquidAlone)
{
    const CarmanKozeny drag{1e13};
    EXPECT_EQ(drag.damping_factor(1.0, 6900, 1e-7), 1.0);
    // 1/(1 + 1e-7 · 1e13/1e-3/6900)
    EXPECT_NEAR(drag.damping_factor(0.0, 6900, 1e-7), 6.9e-6, 1e-9);
    EXPECT_GT(drag.damping_factor(0.9, 6900, 1e-7), drag.damping_factor(0.5, 6900, 1e-7));
    // half liquid: 1e13 · 0.25/0.126 = 1.98413e13; 1/(1 + 287.555)
    EXPECT_NEAR(drag.damping_factor(0.5, 6900, 1e-7), 3.46554e-3, 1e-7);
}

TEST(ImplicitLosses, SatisfyTheirEquationHoweverStiff)
{
    const ThermalMaterial material(steel(), true);
    const SurfaceLosses losses{Evaporation{steel_vapour}, Radiation{0.6, 80, 300}};
    for (const double temperature : {310.0, 1700.0, 2500.0, 3500.0, 5000.0, 12000.0})
        for (const double per_flux : {1e-12, 1e-8, 1e-5, 1e-3}) {
            const double before = material.enthalpy(temperature);
            const double lost = implicit_losses(losses, material, before, per_flux).total();
            const double after = material.temperature(before - lost);
            const auto residual = [&](double x) {
                return per_flux * losses.heat_flux(material.temperature(before - x)).total() - x;
            };
            EXPECT_GE(lost, 0.0);
            EXPECT_LE(after, temperature);
            EXPECT_GT(after, 299.0);
            const double near = 1e-4 * 700 + 1e-9 * lost; // 10⁻⁴ K, and round-off
            EXPECT_GE(residual(lost - near), 0.0) << temperature << " " << per_flux;
            EXPECT_LE(residual(lost + near), 0.0) << temperature << " " << per_flux;
        }
}

TEST(ImplicitLosses, WarmWhatIsColderThanItsSurrounding)
{
    const ThermalMaterial material(steel(), true);
    const SurfaceLosses losses{std::nullopt, Radiation{0.6, 80, 1000}};
    const double before = material.enthalpy(400);
    const double lost = implicit_losses(losses, material, before, 1000.0).total();
    EXPECT_LT(lost, 0.0);
    EXPECT_LE(material.temperature(before - lost), 1000.0);
    EXPECT_GT(material.temperature(before - lost), 950.0);
}

Case radiating_case(double dx)
{
    Case definition = heat_case(steel(), 3, dx, {"melting", "radiation"});
    Surrounding surrounding;
    surrounding.temperature = 300;
    definition.surrounding = surrounding;
    definition.initial.temperature = 1500;
    return definition;
}

double exposed_area(const Scene& scene)
{
    double sum = 0.0;
    for (Index i = 0; i < scene.particles->count(); ++i)
        sum += scene.particles->scalar("exposed_area")[i];
    return sum;
}

/// Share of the flat area that particles well away from the sides expose.
double plate_area_share(double dx, double jitter)
{
    const double half = 1.2e-4, middle = half - 4 * dx;
    Case definition = radiating_case(dx);
    definition.domain.lower = {-half, -half, -half};
    definition.domain.upper = {half, half, half};
    for (const Side side : {Side::x_min, Side::x_max, Side::y_min, Side::y_max, Side::z_min})
        definition.domain.boundaries[std::size_t(side)] = wall();
    Scene scene = lattice_scene(definition, {-half, -half, -half}, {half, half, 0}, jitter);
    ThermalStep step(scene);
    const NeighbourList list = neighbours(scene);
    step.advance(list, 0, 1e-9);
    double sum = 0.0;
    for (Index i = 0; i < scene.particles->count(); ++i)
        if (const Vector p = scene.particles->position[i]; std::abs(p.x) < middle && std::abs(p.y) < middle)
            sum += scene.particles->scalar("exposed_area")[i];
    return sum / (4 * middle * middle);
}

TEST(ExposedSurface, OfAPlateBetweenWallsIsItsTopAlone)
{
    EXPECT_NEAR(plate_area_share(1e-5, 0.0), 1.0, 0.01);
    EXPECT_NEAR(plate_area_share(1e-5, 0.2), 1.0, 0.01);
}

TEST(ExposedSurface, OfABallIsItsArea)
{
    const double dx = 1e-5, radius = 8e-5;
    Scene scene = lattice_scene(radiating_case(dx), {-1e-4, -1e-4, -1e-4}, {1e-4, 1e-4, 1e-4}, 0.1,
                                [&](const Vector& p) { return dot(p, p) < radius * radius; });
    ThermalStep step(scene);
    const NeighbourList list = neighbours(scene);
    step.advance(list, 0, 1e-9);
    const double share = exposed_area(scene) / (4 * std::numbers::pi * radius * radius);
    RecordProperty("area", std::to_string(share));
    EXPECT_NEAR(share, 1.0, 0.1);
}

TEST(ExposedSurface, OfGrainsOfOneToFourParticlesIsThatOfASphereWithinHalf)
{
    const double dx = 1e-5;
    for (int count = 1; count <= 4; ++count) {
        int left = count;
        Scene scene = lattice_scene(radiating_case(dx), {0, 0, 0}, {2 * dx, 2 * dx, dx}, 0.0,
                                    [&](const Vector&) { return left-- > 0; });
        ThermalStep step(scene);
        const NeighbourList list = neighbours(scene);
        step.advance(list, 0, 1e-9);
        // A sphere of a particle's volume has 4.84 Δx²: one particle exposes most of it, several hide parts of each
        // other.
        EXPECT_LE(exposed_area(scene), 4.84 * dx * dx * count);
        EXPECT_GE(exposed_area(scene), 0.5 * 4.84 * dx * dx * std::pow(count, 2.0 / 3.0));
    }
}

} // namespace
} // namespace cupel::thermal_tests
