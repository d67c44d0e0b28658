#include "scene/schema.hpp"

#include "scene/declaration.hpp"
#include "scene/nearest.hpp"
#include "scene/physics.hpp"

#include <fmt/format.h>

namespace cupel
{

namespace
{

using nlohmann::json;

json number_schema(const Bounds& bounds)
{
    json schema{{"type", "number"}};
    if (bounds.above) schema["exclusiveMinimum"] = *bounds.above;
    if (bounds.at_least) schema["minimum"] = *bounds.at_least;
    if (bounds.below) schema["exclusiveMaximum"] = *bounds.below;
    if (bounds.at_most) schema["maximum"] = *bounds.at_most;
    return schema;
}

/// A text that begins with a number, with a unit behind it.
json quantity_schema(const std::string& unit, const Bounds& bounds)
{
    static const std::string number = R"(^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*)";
    if (unit == "1") return {{"anyOf", {number_schema(bounds), {{"type", "string"}, {"pattern", number + "%?\\s*$"}}}}};
    return {{"type", "string"}, {"pattern", number + R"([^\d\s.+-].*$)"}};
}

json value_schema(const Parameter& parameter)
{
    switch (parameter.type) {
    case Type::quantity:
        return quantity_schema(parameter.unit, parameter.bounds);
    case Type::vector:
        return {{"type", "array"},
                {"items", quantity_schema(parameter.unit, parameter.bounds)},
                {"minItems", parameter.components},
                {"maxItems", parameter.components}};
    case Type::integer: {
        json schema = number_schema(parameter.bounds);
        schema["type"] = "integer";
        return schema;
    }
    case Type::boolean:
        return {{"type", "boolean"}};
    case Type::strength:
        return {{"anyOf", {{{"type", "boolean"}}, number_schema(parameter.bounds)}}};
    case Type::text:
    case Type::file:
        return {{"type", "string"}};
    case Type::text_list:
        return {{"type", "array"}, {"items", {{"type", "string"}}}};
    case Type::choice:
        return {{"enum", parameter.choices}};
    case Type::choice_list:
        return {{"type", "array"}, {"items", {{"enum", parameter.choices}}}, {"uniqueItems", true}};
    case Type::time_window:
        return {{"type", "array"}, {"items", {{"type", "string"}}}, {"minItems", 2}, {"maxItems", 2}};
    case Type::any_quantity:
        return {{"type", {"string", "number"}}};
    case Type::by_level: {
        const json one{{"type", {"string", "number"}}};
        json levels{{"type", "object"}, {"properties", json::object()}, {"additionalProperties", false}};
        for (const std::string& level : level_names())
            levels["properties"][level] = one;
        return {{"anyOf", {one, levels}}};
    }
    }
    return json::object();
}

std::string default_text(const Parameter& parameter)
{
    if (parameter.required) return "required";
    std::string text = !parameter.derivation.empty() ? parameter.derivation
                       : parameter.fallback          ? parameter.fallback->dump()
                                                     : "none";
    if (parameter.paper_fallback)
        text += fmt::format(" ({} with the paper's formulation)", parameter.paper_fallback->dump());
    return text;
}

json parameter_schema(const Parameter& parameter)
{
    const json value = value_schema(parameter);
    const json annotated{
        {"type", "object"},
        {"properties", {{"value", value}, {"assumed", {{"type", "string"}}}, {"source", {{"type", "string"}}}}},
        {"required", {"value"}},
        {"additionalProperties", false}};
    json schema{{"description", parameter.help + "; default: " + default_text(parameter)},
                {"anyOf", {value, annotated}}};
    if (parameter.fallback) schema["default"] = *parameter.fallback;
    if (parameter.unit != "1") schema["x-unit"] = parameter.unit;
    return schema;
}

json table_schema(const Table& table);

json occurrence_schema(const Table& table)
{
    const json one = table_schema(table);
    if (table.occurrence == Table::Occurrence::named)
        return {{"type", "object"}, {"description", table.help}, {"additionalProperties", one}};
    if (table.occurrence == Table::Occurrence::listed)
        return {{"type", "array"}, {"description", table.help}, {"items", one}};
    return one;
}

json table_schema(const Table& table)
{
    json properties = json::object();
    for (const Parameter& parameter : table.parameters)
        properties[parameter.key] = parameter_schema(parameter);
    for (const Table& inner : table.tables)
        properties[inner.key] = occurrence_schema(inner);
    if (table.key == "material")
        properties["use"] = {{"type", "string"}, {"description", "name of a file in a folder materials/"}};
    return {
        {"type", "object"}, {"description", table.help}, {"properties", properties}, {"additionalProperties", false}};
}

std::string bounds_text(const Parameter& parameter)
{
    std::string text;
    const auto add = [&](const char* sign, const std::optional<double>& limit) {
        if (limit) text += fmt::format("{}{} {:.4g}", text.empty() ? "" : ", ", sign, *limit);
    };
    add(">", parameter.bounds.above);
    add("≥", parameter.bounds.at_least);
    add("<", parameter.bounds.below);
    add("≤", parameter.bounds.at_most);
    return text;
}

std::string kind_of(const Parameter& parameter)
{
    switch (parameter.type) {
    case Type::quantity:
        return parameter.unit == "1" ? "number" : parameter.unit;
    case Type::vector:
        return fmt::format("{} × {}", parameter.components, parameter.unit);
    case Type::integer:
        return "whole number";
    case Type::boolean:
        return "true, false";
    case Type::strength:
        return "number, true, false";
    case Type::text:
        return "text";
    case Type::file:
        return "path";
    case Type::text_list:
        return "list of texts";
    case Type::choice:
        return joined(parameter.choices);
    case Type::choice_list:
        return "some of " + joined(parameter.choices);
    case Type::time_window:
        return "two times, either of which may be \"end\"";
    case Type::any_quantity:
        return "number with the measure's unit";
    case Type::by_level:
        return "number with the measure's unit, or a table of one a level";
    }
    return "";
}

std::string heading(const Table& table, const std::string& path)
{
    if (table.occurrence == Table::Occurrence::named) return fmt::format("[{}.NAME]", path);
    if (table.occurrence == Table::Occurrence::listed) return fmt::format("[[{}]]", path);
    return path.empty() ? "At the top of the file" : fmt::format("[{}]", path);
}

void write_table(const Table& table, const std::string& path, std::string& text)
{
    const std::string goes_with =
        table.only_with.empty() ? "" : fmt::format(" (with {} {})", table.only_with, joined(table.only_values));
    text += fmt::format("\n## {}\n\n{}{}.\n", heading(table, path), table.help, goes_with);
    if (!table.parameters.empty()) text += "\n| Key | Value | Bounds | Default | Meaning |\n|---|---|---|---|---|\n";
    for (const Parameter& parameter : table.parameters) {
        const std::string condition = parameter.only_with.empty() ? ""
                                                                  : fmt::format(" (with {} {})", parameter.only_with,
                                                                                joined(parameter.only_values));
        text += fmt::format("| `{}` | {} | {} | {} | {}{} |\n", parameter.key, kind_of(parameter),
                            bounds_text(parameter), default_text(parameter), parameter.help, condition);
    }
    for (const Table& inner : table.tables)
        write_table(inner, path.empty() ? inner.key : path + "." + inner.key, text);
}

std::string own_reference_text(MeasureDeclaration::OwnReference own)
{
    switch (own) {
    case MeasureDeclaration::OwnReference::none:
        return "none";
    case MeasureDeclaration::OwnReference::computed:
        return "computed";
    case MeasureDeclaration::OwnReference::zero:
        return "0";
    }
    return "";
}

} // namespace

json case_schema()
{
    json schema = table_schema(case_declaration());
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
    schema["title"] = "Cupel case file";
    schema["properties"]["base"] = {{"type", "string"},
                                    {"description", "file that lies underneath, relative to this one"}};
    schema["properties"]["sweep"] = {{"type", "object"},
                                     {"description", "variations of the case: [sweep.NAME] lies over the file"},
                                     {"propertyNames", {{"pattern", "^[A-Za-z0-9_]+$"}}},
                                     {"additionalProperties", {{"type", "object"}}}};
    return schema;
}

std::string parameter_reference()
{
    std::string text =
        "# Parameters of a case file\n\nAny value may be written as `{ value = ..., assumed = \"reason\" }` or "
        "`{ value = ..., source = \"where from\" }`.\n";
    write_table(case_declaration(), "", text);
    text += "\n## Physics\n\n| Name | Needs | Meaning |\n|---|---|---|\n";
    for (const PhysicsDeclaration& physics : physics_declarations())
        text += fmt::format("| `{}` | {} | {} |\n", physics.name, joined(physics.needs), physics.help);
    text += "\n## Measures\n\n| Name | Unit | Reference of its own | Meaning |\n|---|---|---|---|\n";
    for (const MeasureDeclaration& measure : measure_declarations())
        text += fmt::format("| `{}` | {} | {} | {} |\n", measure.name, measure.unit,
                            own_reference_text(measure.own_reference), measure.help);
    return text;
}

} // namespace cupel
