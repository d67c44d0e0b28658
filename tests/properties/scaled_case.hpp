/// A resolved case in other units of length, mass, time and temperature.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "scene/declaration.hpp"
#include "scene/powder_bed.hpp"
#include "scene/units.hpp"

namespace cupel::properties
{

/// How many new units an old one is worth, as powers of sixteen: then every product, quotient and square root of scaled
/// numbers is the old one times a power of two, digit for digit.
///
/// The units of temperature and amount of substance follow from the others, so that the constants of nature keep their
/// numbers: Stefan and Boltzmann's [kg/(s³ K⁴)] and the gas constant's [kg m²/(s² K mol)].
struct UnitScale
{
    int length, mass, time;

    double factor(const Dimension& dimension) const
    {
        const int temperature_quarters = mass - 3 * time;
        const int amount_quarters = 4 * (mass + 2 * length - 2 * time) - temperature_quarters;
        const auto& e = dimension.exponents;
        const int quarters =
            4 * (e[0] * length + e[1] * mass + e[2] * time) + e[3] * temperature_quarters + e[4] * amount_quarters;
        return std::exp2(quarters);
    }
    double factor(const std::string& unit) const { return factor(parse_unit(unit).dimension); }
};

class ScaledCase
{
public:
    /// `folder` takes the scaled powder bed of a case that has one.
    ScaledCase(UnitScale scale, std::filesystem::path folder) : scale_(scale), folder_(std::move(folder)) {}

    /// The resolved case in other units. Throws std::logic_error for a number of which no declaration knows the unit.
    nlohmann::json operator()(nlohmann::json resolved) const
    {
        const Table& whole = case_declaration();
        scale_number(resolved.at("spacing"), "m");
        for (auto& [key, value] : resolved.items()) {
            if (not_computed_with(key) || key == "spacing") continue;
            const std::string declared = key == "materials" ? "material" : key == "bodies" ? "body" : key;
            if (const Table* table = find(whole.tables, declared)) {
                if (value.is_null()) continue;
                if (table->occurrence == Table::Occurrence::once)
                    scale_table(value, *table);
                else
                    for (auto& item : value)
                        scale_table(item, *table);
            }
            else
                scale_parameter(value, whole, key);
        }
        return resolved;
    }

private:
    static bool not_computed_with(const std::string& key)
    {
        for (const char* name : {"measures", "powder", "assumed", "sources", "schema"})
            if (key == name) return true;
        return false;
    }

    template <class Item> static const Item* find(const std::vector<Item>& items, const std::string& key)
    {
        for (const Item& item : items)
            if (item.key == key) return &item;
        return nullptr;
    }

    void scale_table(nlohmann::json& values, const Table& table) const
    {
        for (auto& [key, value] : values.items()) {
            if (value.is_null()) continue;
            if (const Table* inner = find(table.tables, key))
                scale_table(value, *inner);
            else if (key == "spot_radius")
                scale_number(value, "m"); // half of what the case file declares
            else if (key == "file")
                value = scaled_bed(value);
            else
                scale_parameter(value, table, key);
        }
    }

    void scale_parameter(nlohmann::json& value, const Table& table, const std::string& key) const
    {
        if (!value.is_number() && !value.is_array()) return;
        if (value.is_array() && (value.empty() || !value.front().is_number())) return;
        const Parameter* parameter = find(table.parameters, key);
        if (!parameter) throw std::logic_error("no declaration says which unit " + table.key + "." + key + " has");
        if (value.is_array())
            for (auto& component : value)
                scale_number(component, parameter->unit);
        else if (parameter->type != Type::integer)
            scale_number(value, parameter->unit);
    }

    void scale_number(nlohmann::json& value, const std::string& unit) const
    {
        value = value.get<double>() * scale_.factor(unit);
    }

    std::string scaled_bed(const std::string& path) const
    {
        const std::filesystem::path scaled = folder_ / "bed.csv";
        std::ofstream file(scaled);
        file << "x_m,y_m,z_m,radius_m\n";
        const double length = scale_.factor("m");
        for (const Grain& grain : read_powder_bed(path))
            file << fmt::format("{},{},{},{}\n", length * grain.center[0], length * grain.center[1],
                                length * grain.center[2], length * grain.radius);
        return scaled.string();
    }

    UnitScale scale_;
    std::filesystem::path folder_;
};

} // namespace cupel::properties
