/// Units in case files: text such as "20 um", "-4.3e-4 N/(m K)" or "45 deg" to SI values.
///
/// A unit is a product or quotient of powers: names joined by a blank, `*` or `/`, powers as `m^3` or `m3`, brackets
/// around a denominator of several factors. `a/b c` is refused because readers disagree on what it means.
/// SI prefixes from f to T go with every unit but the angles, %, bar, atm and min. Angle is a dimension of its own, so
/// that a contact angle of "45" is refused.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace cupel
{

/// Exponents of length, mass, time, temperature, amount of substance and angle.
struct Dimension
{
    std::array<int, 6> exponents{};

    bool operator==(const Dimension&) const = default;
    bool none() const { return *this == Dimension{}; }
};

/// Factor to SI: `factor` times ten to the power `decimal_exponent`, kept apart so that "20 um" is exactly 2e-5.
struct Unit
{
    Dimension dimension;
    int decimal_exponent = 0;
    double factor = 1;
};

struct Quantity
{
    double value = 0; ///< SI
    Dimension dimension;
};

/// A text that is no quantity or no unit; what() says why.
class UnitError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

/// "N/(m K)" to its factor and dimension; the empty text is the number one. Throws UnitError.
Unit parse_unit(std::string_view text);

/// "20 um" to 2e-5 m. Throws UnitError, naming the nearest known unit where a name is unknown.
Quantity parse_quantity(std::string_view text);

/// Dimension in base units, e.g. "kg m/s^2"; "1" where there is none.
std::string dimension_text(const Dimension& dimension);

} // namespace cupel
