/// What a case file may say: one declaration a parameter.
///
/// A declaration gives the parser, the unit conversion, the default, the bounds check, the help text, the JSON schema
/// and the key of the resolved case. To add a parameter, add one line to a declarations_*.cpp file.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace cupel
{

enum class Type {
    quantity,     ///< number with the declared unit; "1" is a plain number or a percentage
    vector,       ///< list of `components` quantities
    integer,      ///< whole number
    boolean,      ///< true or false
    strength,     ///< number, or true = 1 and false = 0
    text,         ///< any text
    text_list,    ///< list of texts
    choice,       ///< one of `choices`
    choice_list,  ///< list of some of `choices`, none twice
    file,         ///< path relative to the file in which it stands
    time_window,  ///< two times, of which the second or both may be "end"
    any_quantity, ///< quantity whose unit follows from another key of the same table
    by_level,     ///< any_quantity, or a table of one a level
};

/// Bounds of a value in SI; each may be absent.
struct Bounds
{
    std::optional<double> above;
    std::optional<double> at_least;
    std::optional<double> below;
    std::optional<double> at_most;
};

struct Parameter
{
    std::string key;
    Type type = Type::quantity;
    std::string unit = "1"; ///< SI unit of the resolved value
    std::string help;
    Bounds bounds;
    std::vector<std::string> choices;
    std::size_t components = 0;
    bool required = false;
    std::optional<nlohmann::json> fallback;       ///< default in SI; absent and not required: the key may be absent
    std::optional<nlohmann::json> paper_fallback; ///< default with numerics.formulation = "paper", where it differs
    std::string derivation;                       ///< how a default that is no constant comes about
    std::string only_with;                        ///< the key of the same table that decides whether this one applies
    std::vector<std::string> only_values;         ///< the values of only_with with which it applies

    Parameter& must() { return required = true, *this; }
    Parameter& or_else(nlohmann::json value) { return fallback = std::move(value), *this; }
    Parameter& in_paper(nlohmann::json value) { return paper_fallback = std::move(value), *this; }
    Parameter& derived(std::string text) { return derivation = std::move(text), *this; }
    Parameter& above(double value) { return bounds.above = value, *this; }
    Parameter& at_least(double value) { return bounds.at_least = value, *this; }
    Parameter& below(double value) { return bounds.below = value, *this; }
    Parameter& at_most(double value) { return bounds.at_most = value, *this; }
    Parameter& with(std::string key_name, std::vector<std::string> values)
    {
        only_with = std::move(key_name);
        only_values = std::move(values);
        return *this;
    }
};

struct Table
{
    enum class Occurrence {
        once,   ///< [key]
        named,  ///< [key.NAME]
        listed, ///< [[key]]
    };

    std::string key;
    std::string help;
    Occurrence occurrence = Occurrence::once;
    bool required = false;
    bool filled = false; ///< an absent table still gives its defaults
    std::vector<Parameter> parameters{};
    std::vector<Table> tables{};
    std::string only_with{};                ///< the parameter beside it that decides whether this table applies
    std::vector<std::string> only_values{}; ///< the values of only_with with which it applies

    Table& with(std::string key_name, std::vector<std::string> values)
    {
        only_with = std::move(key_name);
        only_values = std::move(values);
        return *this;
    }
};

Parameter quantity(std::string key, std::string unit, std::string help);
Parameter vector(std::string key, std::size_t components, std::string unit, std::string help);
Parameter choice(std::string key, std::vector<std::string> choices, std::string help);
Parameter choice_list(std::string key, std::vector<std::string> choices, std::string help);
Parameter plain(std::string key, Type type, std::string help);

/// The whole case file.
const Table& case_declaration();

/// Parts of it, each in its file.
Table material_declaration();
Table numerics_declaration();
Table powder_declaration();
Table domain_declaration();
Table body_declaration();
Table initial_declaration();
Table measure_declaration();

/// A quantity that a result can be judged by.
struct MeasureDeclaration
{
    /// What a measure can work out of the resolved case where the case file names no value.
    enum class OwnReference {
        none,     ///< nothing: the case file gives the value
        computed, ///< the exact or tabulated value
        zero,     ///< the measure is an error already, which has no share of itself
    };

    std::string name;
    std::string unit;
    std::string help;
    OwnReference own_reference = OwnReference::none;
};

const std::vector<MeasureDeclaration>& measure_declarations();

/// Levels of resolution, cheapest first.
const std::vector<std::string>& level_names();

/// Tiers of the suite.
const std::vector<std::string>& tier_names();

} // namespace cupel
