#include <gtest/gtest.h>

#include <cmath>

#include "models/enthalpy.hpp"
#include "thermal/thermal_scene.hpp"

namespace cupel::thermal_tests
{
namespace
{

TEST(Enthalpy, TemperatureComesBackFromItsEnthalpyToRoundOff)
{
    for (const double latent_heat : {0.0, 247000.0, 2.47e6})
        for (const double liquidus : {1673.001, 1773.0, 2500.0})
            for (const double specific_heat : {300.0, 700.0, 1500.0}) {
                Material material = steel();
                material.latent_heat = latent_heat;
                material.liquidus = liquidus;
                material.specific_heat = specific_heat;
                const ThermalMaterial thermal(material, true);
                for (double t = 1.0; t < 6000.0; t += 7.3)
                    EXPECT_NEAR(thermal.temperature(thermal.enthalpy(t)), t, 1e-12 * t);
                for (double share = 0.0; share <= 1.0; share += 1.0 / 64) {
                    const double t = 1673.0 + share * (liquidus - 1673.0);
                    EXPECT_NEAR(thermal.temperature(thermal.enthalpy(t)), t, 1e-9);
                }
            }
}

TEST(Enthalpy, EnthalpyComesBackFromItsTemperature)
{
    const ThermalMaterial thermal(steel(), true);
    for (double h = 1e3; h < 4e6; h += 1234.5)
        EXPECT_NEAR(thermal.enthalpy(thermal.temperature(h)), h, 1e-11 * h);
}

TEST(Enthalpy, MeltingTakesTheLatentHeatAndTheMeanSpecificHeat)
{
    const ThermalMaterial thermal(steel(), true);
    // ½ (700 + 780) · 100 + 247 000
    EXPECT_NEAR(thermal.enthalpy(1773.0) - thermal.enthalpy(1673.0), 321000.0, 1e-6);
    EXPECT_NEAR(thermal.enthalpy(300.0), 210000.0, 1e-9);
    EXPECT_NEAR(thermal.enthalpy(2000.0), 700.0 * 1673.0 + 321000.0 + 780.0 * 227.0, 1e-6);
    // Midway: 50 K at c from 700 to 740, and half the latent heat.
    EXPECT_NEAR(thermal.enthalpy(1723.0), 700.0 * 1673.0 + 0.5 * (700.0 + 740.0) * 50.0 + 123500.0, 1e-6);
}

TEST(Enthalpy, LiquidFractionIsLinearInTemperature)
{
    const ThermalMaterial thermal(steel(), true);
    for (double f = 0.0; f <= 1.0; f += 0.125)
        EXPECT_NEAR(thermal.liquid_fraction(thermal.enthalpy(1673.0 + 100.0 * f)), f, 1e-13);
    EXPECT_EQ(thermal.liquid_fraction(thermal.enthalpy(1600.0)), 0.0);
    EXPECT_EQ(thermal.liquid_fraction(thermal.enthalpy(1800.0)), 1.0);
}

TEST(Enthalpy, ConductivityMixesByLiquidFraction)
{
    const ThermalMaterial thermal(steel(), true);
    EXPECT_DOUBLE_EQ(thermal.conductivity(0.0), 36.7);
    EXPECT_DOUBLE_EQ(thermal.conductivity(1.0), 18.1);
    EXPECT_DOUBLE_EQ(thermal.conductivity(0.25), 0.75 * 36.7 + 0.25 * 18.1);
}

TEST(Enthalpy, PureMetalMeltsAtOneTemperature)
{
    Material material = steel();
    material.liquidus = material.solidus;
    const ThermalMaterial thermal(material, true);
    const double solid = 700.0 * 1673.0;
    EXPECT_DOUBLE_EQ(thermal.enthalpy(1673.0), solid);
    for (double f = 0.125; f < 1.0; f += 0.125) {
        EXPECT_NEAR(thermal.liquid_fraction(solid + f * 247000.0), f, 1e-14);
        EXPECT_EQ(thermal.temperature(solid + f * 247000.0), 1673.0);
    }
    EXPECT_NEAR(thermal.temperature(solid + 247000.0 + 780.0), 1674.0, 1e-9);
    material.latent_heat = 0.0;
    const ThermalMaterial without(material, true);
    EXPECT_NEAR(without.temperature(solid + 780.0), 1674.0, 1e-9);
    EXPECT_NEAR(without.temperature(solid - 700.0), 1672.0, 1e-9);
}

TEST(Enthalpy, WithoutMeltingThereIsOneBranch)
{
    for (const ThermalMaterial& thermal : {ThermalMaterial(plain_metal(), true), ThermalMaterial(steel(), false)}) {
        EXPECT_FALSE(thermal.melts);
        EXPECT_DOUBLE_EQ(thermal.enthalpy(2000.0), 780.0 * 2000.0);
        EXPECT_DOUBLE_EQ(thermal.temperature(780.0 * 1700.0), 1700.0);
        EXPECT_EQ(thermal.liquid_fraction(0.0), 1.0);
    }
}

TEST(Enthalpy, WhatHeatNeedsIsNamedWhereItIsMissing)
{
    Material material = plain_metal();
    material.conductivity.reset();
    try {
        ThermalMaterial thermal(material, false);
        FAIL() << "a material without conductivity was taken";
    }
    catch (const CaseError& error) {
        EXPECT_NE(std::string(error.what()).find("material.metal.conductivity"), std::string::npos);
    }
    Material turned = steel();
    turned.liquidus = 1600;
    EXPECT_THROW(ThermalMaterial(turned, true), CaseError);
}

} // namespace
} // namespace cupel::thermal_tests
