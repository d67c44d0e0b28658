#include "scene/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace cupel
{
namespace
{

std::string problem_with(const std::string& text)
{
    try {
        parse_quantity(text);
    }
    catch (const UnitError& error) {
        return error.what();
    }
    return "";
}

TEST(Units, PrefixedValueIsTheNearestDoubleToTheDecimalNumber)
{
    EXPECT_EQ(parse_quantity("20 um").value, 2e-5);
    EXPECT_EQ(parse_quantity("160 \u00b5m").value, 1.6e-4);
    EXPECT_EQ(parse_quantity("6.67 ms").value, 6.67e-3);
    EXPECT_EQ(parse_quantity("10 %").value, 0.1);
    EXPECT_EQ(parse_quantity("247 kJ/kg").value, 247e3);
    EXPECT_EQ(parse_quantity("+1.5e-3 mm").value, 1.5e-6);
}

TEST(Units, DerivedUnitsAreProductsOfBaseUnits)
{
    EXPECT_EQ(parse_unit("N/m").dimension, parse_unit("J/m^2").dimension);
    EXPECT_EQ(parse_unit("W").dimension, parse_unit("J/s").dimension);
    EXPECT_EQ(parse_unit("Pa s").dimension, parse_unit("kg/(m s)").dimension);
    EXPECT_EQ(parse_unit("N").dimension, parse_unit("kg m s^-2").dimension);
    EXPECT_EQ(parse_unit("kg/m3").dimension, parse_unit("kg / m^3").dimension);
    EXPECT_NE(parse_unit("Pa").dimension, parse_unit("N").dimension);
}

TEST(Units, DegreesAreAnglesAndNotPlainNumbers)
{
    EXPECT_DOUBLE_EQ(parse_quantity("45 deg").value, std::numbers::pi / 4);
    EXPECT_NE(parse_quantity("45 deg").dimension, parse_quantity("45").dimension);
    EXPECT_EQ(parse_quantity("45 deg").dimension, parse_quantity("1 rad").dimension);
}

TEST(Units, MetreAndMilliAreToldApart)
{
    EXPECT_EQ(parse_quantity("1 m").dimension, parse_quantity("1 mm").dimension);
    EXPECT_EQ(parse_quantity("1 mm").value, 1e-3);
    EXPECT_EQ(parse_quantity("1 m m").dimension, parse_unit("m^2").dimension);
    EXPECT_EQ(parse_quantity("1 min").value, 60);
    EXPECT_EQ(parse_quantity("1 mol").dimension, parse_unit("mol").dimension);
    EXPECT_EQ(parse_quantity("1 Pa").value, 1);
}

TEST(Units, WhatStandsAfterAQuotientNeedsBrackets)
{
    EXPECT_THAT(problem_with("1 W/m K"), ::testing::HasSubstr("ambiguous"));
    EXPECT_EQ(problem_with("1 W/(m K)"), "");
    EXPECT_EQ(parse_unit("J/kg/K").dimension, parse_unit("J/(kg K)").dimension);
}

TEST(Units, UnknownUnitNamesTheNearest)
{
    EXPECT_THAT(problem_with("20 umm"), ::testing::HasSubstr("did you mean 'um'?"));
    EXPECT_THAT(problem_with("20 Kelvin"), ::testing::HasSubstr("'Kelvin' is not known"));
}

TEST(Units, WhatIsNoQuantityIsRefused)
{
    for (const char* text : {"", "um", "1 (m", "1 m)", "1 m^", "1 m^0", "1 m^99", "1 /", "--1 m", "1 m//s", "1e400 m",
                             "1,5 m", "1 kdeg", "0x10 m", "1 %m/", "1..2 m", "e5 m"})
        EXPECT_NE(problem_with(text), "") << text;
}

/// Any product of powers, written in any order, with or without brackets, has the sum of the powers as its dimension.
TEST(UnitsProperty, ProductsOfPowersAddTheirExponents)
{
    const std::vector<std::string> names{"m", "kg", "s", "K", "mol", "rad"};
    std::mt19937 generator(1);
    std::uniform_int_distribution<int> exponent(-4, 4);
    std::uniform_int_distribution<std::size_t> name(0, names.size() - 1);
    const std::array<std::size_t, 6> base_of_name{0, 1, 2, 3, 4, 5};
    for (int trial = 0; trial < 500; ++trial) {
        Dimension wanted;
        std::string above = "1";
        std::string below = "1";
        for (int factor = 0; factor < 4; ++factor) {
            const std::size_t index = name(generator);
            int power = exponent(generator);
            power = power == 0 ? 1 : power;
            std::string& side = trial % 2 == 0 && power < 0 ? below : above;
            const int written = &side == &below ? -power : power;
            side += " " + names[index] + "^" + std::to_string(written);
            wanted.exponents[base_of_name[index]] += power;
        }
        const std::string text = above + "/(" + below + ")";
        EXPECT_EQ(parse_unit(text).dimension, wanted) << text;
    }
}

/// The dimension's own text is a unit of that dimension.
TEST(UnitsProperty, DimensionTextReadsBackAsItself)
{
    std::mt19937 generator(2);
    std::uniform_int_distribution<int> exponent(-3, 3);
    for (int trial = 0; trial < 500; ++trial) {
        Dimension dimension;
        for (int& each : dimension.exponents)
            each = exponent(generator);
        EXPECT_EQ(parse_unit(dimension_text(dimension)).dimension, dimension) << dimension_text(dimension);
    }
}

/// A value is the same whatever prefix it is written with.
TEST(UnitsProperty, PrefixesOnlyShiftTheDecimalPoint)
{
    const std::vector<std::pair<std::string, int>> prefixes{{"f", -15}, {"p", -12}, {"n", -9}, {"u", -6},
                                                            {"m", -3},  {"c", -2},  {"d", -1}, {"", 0},
                                                            {"h", 2},   {"k", 3},   {"M", 6},  {"G", 9}};
    std::mt19937 generator(3);
    std::uniform_int_distribution<int> mantissa(1, 99999);
    for (const std::string unit : {"m", "s", "N", "Pa", "W", "J", "Hz", "K", "mol"})
        for (const auto& [prefix, exponent] : prefixes)
            for (int trial = 0; trial < 20; ++trial) {
                const std::string digits = std::to_string(mantissa(generator));
                const double wanted = std::stod(digits + "e" + std::to_string(exponent));
                EXPECT_EQ(parse_quantity(digits + " " + prefix + unit).value, wanted)
                    << digits << " " << prefix << unit;
            }
}

} // namespace
} // namespace cupel
