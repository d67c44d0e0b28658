#include "scene/units.hpp"

#include "scene/nearest.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace cupel
{

namespace
{

struct NamedUnit
{
    const char* name;
    Unit unit;
    bool prefixes;
};

struct Prefix
{
    const char* name;
    int exponent;
};

constexpr Dimension dimension_of(int length, int mass, int time, int temperature = 0, int amount = 0, int angle = 0)
{
    return {{length, mass, time, temperature, amount, angle}};
}

const std::vector<NamedUnit>& named_units()
{
    static const std::vector<NamedUnit> units{
        {"m", {dimension_of(1, 0, 0), 0, 1}, true},
        {"g", {dimension_of(0, 1, 0), -3, 1}, true},
        {"s", {dimension_of(0, 0, 1), 0, 1}, true},
        {"K", {dimension_of(0, 0, 0, 1), 0, 1}, true},
        {"mol", {dimension_of(0, 0, 0, 0, 1), 0, 1}, true},
        {"N", {dimension_of(1, 1, -2), 0, 1}, true},
        {"Pa", {dimension_of(-1, 1, -2), 0, 1}, true},
        {"J", {dimension_of(2, 1, -2), 0, 1}, true},
        {"W", {dimension_of(2, 1, -3), 0, 1}, true},
        {"Hz", {dimension_of(0, 0, -1), 0, 1}, true},
        {"rad", {dimension_of(0, 0, 0, 0, 0, 1), 0, 1}, true},
        {"deg", {dimension_of(0, 0, 0, 0, 0, 1), 0, std::numbers::pi / 180}, false},
        {"%", {dimension_of(0, 0, 0), -2, 1}, false},
        {"bar", {dimension_of(-1, 1, -2), 5, 1}, false},
        {"atm", {dimension_of(-1, 1, -2), 0, 101325}, false},
        {"min", {dimension_of(0, 0, 1), 0, 60}, false}};
    return units;
}

constexpr std::array<Prefix, 14> prefixes{{{"f", -15},
                                           {"p", -12},
                                           {"n", -9},
                                           {"u", -6},
                                           {"\u00b5", -6},
                                           {"\u03bc", -6},
                                           {"m", -3},
                                           {"c", -2},
                                           {"d", -1},
                                           {"h", 2},
                                           {"k", 3},
                                           {"M", 6},
                                           {"G", 9},
                                           {"T", 12}}};

std::optional<Unit> find_unit(std::string_view name)
{
    for (const NamedUnit& candidate : named_units())
        if (name == candidate.name) return candidate.unit;
    for (const NamedUnit& candidate : named_units()) {
        if (!candidate.prefixes || !name.ends_with(candidate.name)) continue;
        const std::string_view front = name.substr(0, name.size() - std::string_view(candidate.name).size());
        for (const Prefix& prefix : prefixes) {
            if (front != prefix.name) continue;
            Unit unit = candidate.unit;
            unit.decimal_exponent += prefix.exponent;
            return unit;
        }
    }
    return std::nullopt;
}

std::vector<std::string> usual_unit_names()
{
    std::vector<std::string> names{"um", "mm", "nm", "kg", "ms", "us", "kW", "mN", "kPa", "MPa", "GPa"};
    for (const NamedUnit& unit : named_units())
        names.emplace_back(unit.name);
    return names;
}

Unit product(const Unit& one, const Unit& other, int sign)
{
    Unit result = one;
    for (std::size_t base = 0; base < result.dimension.exponents.size(); ++base)
        result.dimension.exponents[base] += sign * other.dimension.exponents[base];
    result.decimal_exponent += sign * other.decimal_exponent;
    result.factor = sign > 0 ? one.factor * other.factor : one.factor / other.factor;
    return result;
}

Unit power(const Unit& unit, int exponent)
{
    Unit result;
    for (int times = 0; times < std::abs(exponent); ++times)
        result = product(result, unit, exponent > 0 ? 1 : -1);
    return result;
}

/// Reads `expression = factor { (" " | "*" | "/") factor }`, `factor = (name | "1" | "(" expression ")") [["^"]
/// integer]`.
class UnitReader
{
public:
    explicit UnitReader(std::string_view text) : text_(text) {}

    Unit read()
    {
        const Unit unit = expression();
        if (position_ != text_.size()) fail("'" + std::string(text_.substr(position_)) + "' is left over");
        return unit;
    }

private:
    [[noreturn]] void fail(const std::string& reason) const
    {
        throw UnitError("'" + std::string(text_) + "' is no unit: " + reason);
    }

    void skip_blanks()
    {
        while (position_ < text_.size() && text_[position_] == ' ')
            ++position_;
    }

    bool at(char character) const { return position_ < text_.size() && text_[position_] == character; }

    Unit expression()
    {
        skip_blanks();
        Unit unit = factor();
        bool divided = false;
        for (skip_blanks(); position_ < text_.size() && !at(')'); skip_blanks()) {
            const bool division = at('/');
            if (division || at('*')) ++position_;
            if (divided && !division)
                fail("what stands after '/' is ambiguous, put the denominator in brackets as in N/(m K)");
            divided = divided || division;
            skip_blanks();
            unit = product(unit, factor(), division ? -1 : 1);
        }
        return unit;
    }

    Unit factor()
    {
        Unit unit;
        if (at('(')) {
            ++position_;
            unit = expression();
            if (!at(')')) fail("a bracket is not closed");
            ++position_;
        }
        else if (at('1'))
            ++position_;
        else
            unit = named();
        return power(unit, exponent());
    }

    Unit named()
    {
        const std::size_t start = position_;
        while (position_ < text_.size() && is_letter(text_[position_]))
            ++position_;
        const std::string_view name = text_.substr(start, position_ - start);
        if (name.empty())
            fail(position_ < text_.size() ? "'" + std::string(1, text_[position_]) + "' stands where a unit should"
                                          : "a unit is missing at the end");
        if (const auto unit = find_unit(name)) return *unit;
        fail("'" + std::string(name) + "' is not known" + suggestion(name, usual_unit_names()));
    }

    static bool is_letter(char character)
    {
        return std::isalpha(static_cast<unsigned char>(character)) || character == '%' ||
               static_cast<unsigned char>(character) >= 0x80;
    }

    int exponent()
    {
        const bool marked = at('^');
        if (marked) ++position_;
        int value = 1;
        const char* first = text_.data() + position_;
        const auto [end, problem] = std::from_chars(first, text_.data() + text_.size(), value);
        if (problem == std::errc{} && value != 0 && std::abs(value) <= 9)
            position_ += static_cast<std::size_t>(end - first);
        else if (marked || problem != std::errc::invalid_argument)
            fail("a power must be a whole number from -9 to 9, not 0");
        return value;
    }

    std::string_view text_;
    std::size_t position_ = 0;
};

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && text.front() == ' ')
        text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ')
        text.remove_suffix(1);
    return text;
}

/// Shifts the decimal point in the text itself, so that the result is the double nearest to the decimal number meant.
double scaled(std::string_view number, const Unit& unit)
{
    std::string mantissa(number);
    int exponent = unit.decimal_exponent;
    if (const std::size_t mark = mantissa.find_first_of("eE"); mark != std::string::npos) {
        exponent += std::stoi(mantissa.substr(mark + 1));
        mantissa.resize(mark);
    }
    mantissa += "e" + std::to_string(exponent);
    const char* first = mantissa.data() + (mantissa.front() == '+' ? 1 : 0);
    double value = 0;
    if (std::from_chars(first, mantissa.data() + mantissa.size(), value).ec != std::errc{})
        throw UnitError("'" + std::string(number) + "' is beyond what a double can hold");
    return value * unit.factor;
}

/// Length of the decimal number at the start of a text, 0 where there is none.
std::size_t number_length(std::string_view text)
{
    std::size_t position = 0;
    const auto digits = [&] {
        const std::size_t start = position;
        while (position < text.size() && std::isdigit(static_cast<unsigned char>(text[position])))
            ++position;
        return position - start;
    };
    if (position < text.size() && (text[position] == '+' || text[position] == '-')) ++position;
    std::size_t count = digits();
    if (position < text.size() && text[position] == '.') {
        ++position;
        count += digits();
    }
    if (count == 0) return 0;
    const std::size_t mantissa_end = position;
    if (position < text.size() && (text[position] == 'e' || text[position] == 'E')) {
        ++position;
        if (position < text.size() && (text[position] == '+' || text[position] == '-')) ++position;
        if (const std::size_t length = digits(); length == 0 || length > 4) position = mantissa_end;
    }
    return position;
}

} // namespace

Unit parse_unit(std::string_view text)
{
    const std::string_view stripped = trimmed(text);
    return stripped.empty() ? Unit{} : UnitReader(stripped).read();
}

Quantity parse_quantity(std::string_view text)
{
    const std::string_view stripped = trimmed(text);
    const std::size_t length = number_length(stripped);
    if (length == 0) throw UnitError("'" + std::string(text) + "' does not begin with a number");
    const Unit unit = parse_unit(stripped.substr(length));
    return {scaled(stripped.substr(0, length), unit), unit.dimension};
}

std::string dimension_text(const Dimension& dimension)
{
    static constexpr std::array<const char*, 6> names{"m", "kg", "s", "K", "mol", "rad"};
    std::string above;
    std::string below;
    int below_count = 0;
    for (const std::size_t base : {1, 0, 2, 3, 4, 5}) {
        const int exponent = dimension.exponents[base];
        if (exponent == 0) continue;
        std::string& side = exponent > 0 ? above : below;
        side += (side.empty() ? "" : " ") + std::string(names[base]);
        if (std::abs(exponent) != 1) side += "^" + std::to_string(std::abs(exponent));
        below_count += exponent < 0 ? 1 : 0;
    }
    if (below.empty()) return above.empty() ? "1" : above;
    return (above.empty() ? "1" : above) + "/" + (below_count > 1 ? "(" + below + ")" : below);
}

} // namespace cupel
