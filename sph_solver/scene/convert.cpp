#include "scene/convert.hpp"

#include "scene/nearest.hpp"
#include "scene/units.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace cupel
{

namespace
{

using nlohmann::json;

std::string number_text(double value)
{
    return json(value).dump();
}

std::string with_unit(double value, const std::string& unit)
{
    return number_text(value) + (unit == "1" ? "" : " " + unit);
}

std::string expected(const std::string& unit)
{
    return unit == "1" ? "write a plain number or a percentage, such as 0.1 or \"10 %\""
                       : "write a number with a unit of the kind " + unit + ", such as \"1 " + unit + "\"";
}

template <typename Convert> json list(const Node& node, const std::string& path, Convert convert_item)
{
    require_kind(node, Node::Kind::array, path, "write a list in square brackets");
    json values = json::array();
    for (std::size_t index = 0; index < node.items.size(); ++index)
        values.push_back(convert_item(node.items[index], below(path, std::to_string(index))));
    return values;
}

Quantity parsed(const Node& node, const std::string& unit, const std::string& path)
{
    if (node.is_numeric()) return {node.numeric(), {}};
    if (!node.is(Node::Kind::text)) refuse(node.position, path, "is " + kind_text(node), expected(unit));
    try {
        return parse_quantity(node.text);
    }
    catch (const UnitError& error) {
        refuse(node.position, path, error.what(), expected(unit));
    }
}

double number(const Node& node, const std::string& unit, const std::string& path)
{
    const Quantity quantity = parsed(node, unit, path);
    const Dimension wanted = parse_unit(unit).dimension;
    if (quantity.dimension != wanted)
        refuse(node.position, path,
               quantity.dimension.none()
                   ? "has no unit"
                   : "has the unit " + dimension_text(quantity.dimension) + " instead of " + dimension_text(wanted),
               expected(unit));
    if (!std::isfinite(quantity.value)) refuse(node.position, path, "is not a finite number", expected(unit));
    return quantity.value;
}

template <typename Number>
json bounded(const Parameter& parameter, Number value, const Node& node, const std::string& path)
{
    const Bounds& bounds = parameter.bounds;
    const double amount = static_cast<double>(value);
    const auto out = [&](const std::string& rule, double limit) {
        refuse(node.position, path, "is " + with_unit(amount, parameter.unit),
               "it must be " + rule + " " + with_unit(limit, parameter.unit));
    };
    if (!std::isfinite(amount)) refuse(node.position, path, "is not a finite number", expected(parameter.unit));
    if (bounds.above && !(amount > *bounds.above)) out("above", *bounds.above);
    if (bounds.at_least && !(amount >= *bounds.at_least)) out("at least", *bounds.at_least);
    if (bounds.below && !(amount < *bounds.below)) out("below", *bounds.below);
    if (bounds.at_most && !(amount <= *bounds.at_most)) out("at most", *bounds.at_most);
    return value;
}

json vector_of(const Parameter& parameter, const Node& node, const std::string& path)
{
    const json values = list(node, path, [&](const Node& item, const std::string& key) {
        return bounded(parameter, number(item, parameter.unit, key), item, key);
    });
    if (values.size() != parameter.components)
        refuse(node.position, path, "has " + std::to_string(values.size()) + " components",
               "write " + std::to_string(parameter.components));
    return values;
}

json chosen(const Parameter& parameter, const Node& node, const std::string& path)
{
    require_kind(node, Node::Kind::text, path, "write one of: " + joined(parameter.choices));
    if (std::find(parameter.choices.begin(), parameter.choices.end(), node.text) == parameter.choices.end())
        refuse(node.position, path, "there is no '" + node.text + "'",
               "take one of: " + joined(parameter.choices) + suggestion(node.text, parameter.choices));
    return node.text;
}

json choices(const Parameter& parameter, const Node& node, const std::string& path)
{
    json values = list(node, path, [&](const Node& item, const std::string&) { return chosen(parameter, item, path); });
    for (std::size_t index = 0; index < values.size(); ++index)
        if (std::find(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(index), values[index]) !=
            values.begin() + static_cast<std::ptrdiff_t>(index))
            refuse(node.items[index].position, path, "'" + node.items[index].text + "' stands there twice",
                   "take one out");
    return values;
}

json absolute_path(const Node& node)
{
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(*node.position.file).parent_path();
    return fs::absolute(folder / node.text).lexically_normal().string();
}

json time_window(const Node& node, const std::string& path)
{
    const json values = list(node, path, [&](const Node& item, const std::string& key) {
        const double time = item.is(Node::Kind::text) && item.text == "end" ? -1.0 : number(item, "s", key);
        if (time < 0 && !(item.is(Node::Kind::text) && item.text == "end"))
            refuse(item.position, key, "is before the start", "write a time from 0 s on, or \"end\"");
        return time < 0 ? json("end") : json(time);
    });
    if (values.size() != 2 || (values[0] == "end" && values[1] != "end"))
        refuse(node.position, path, "is no pair of times",
               "write for example [\"1 ms\", \"end\"], or [\"end\", \"end\"] for the last snapshot");
    return values;
}

json any_quantity(const Node& node, const std::string& path)
{
    const Quantity quantity = parsed(node, "1", path);
    return {{"value", quantity.value}, {"dimension", quantity.dimension.exponents}};
}

/// A value for all levels is one for the coarsest: it holds for every finer one that is not named.
json by_level(const Node& node, const std::string& path)
{
    const std::vector<std::string>& levels = level_names();
    if (!node.is(Node::Kind::table)) return {{levels.front(), any_quantity(node, path)}};
    json values = json::object();
    for (const auto& [level, value] : node.members) {
        if (std::find(levels.begin(), levels.end(), level) == levels.end())
            refuse(value.key_position, below(path, level), "there is no such level",
                   "take one of: " + joined(levels) + suggestion(level, levels));
        values[level] = any_quantity(value, below(path, level));
    }
    if (values.empty()) refuse(node.position, path, "names no level", "write for example { coarse = \"1 %\" }");
    return values;
}

} // namespace

std::string below(const std::string& path, const std::string& key)
{
    return path.empty() ? key : path + "." + key;
}

void require_kind(const Node& node, Node::Kind kind, const std::string& path, const std::string& remedy)
{
    if (!node.is(kind)) refuse(node.position, path, "is " + kind_text(node), remedy);
}

json convert_value(const Parameter& parameter, const Node& node, const std::string& path)
{
    switch (parameter.type) {
    case Type::quantity:
        return bounded(parameter, number(node, parameter.unit, path), node, path);
    case Type::vector:
        return vector_of(parameter, node, path);
    case Type::integer:
        require_kind(node, Node::Kind::integer, path, "write a whole number without quotes");
        return bounded(parameter, node.integer, node, path);
    case Type::boolean:
        require_kind(node, Node::Kind::boolean, path, "write true or false without quotes");
        return node.boolean;
    case Type::strength:
        if (node.is(Node::Kind::boolean)) return node.boolean ? 1.0 : 0.0;
        if (!node.is_numeric()) refuse(node.position, path, "is " + kind_text(node), "write true, false or a number");
        return bounded(parameter, node.numeric(), node, path);
    case Type::text:
        require_kind(node, Node::Kind::text, path, "write a text in quotes");
        return node.text;
    case Type::text_list:
        return list(node, path, [&](const Node& item, const std::string& key) {
            require_kind(item, Node::Kind::text, key, "write a text in quotes");
            return json(item.text);
        });
    case Type::choice:
        return chosen(parameter, node, path);
    case Type::choice_list:
        return choices(parameter, node, path);
    case Type::file:
        require_kind(node, Node::Kind::text, path, "write a path in quotes");
        return absolute_path(node);
    case Type::time_window:
        return time_window(node, path);
    case Type::any_quantity:
        return any_quantity(node, path);
    case Type::by_level:
        return by_level(node, path);
    }
    return nullptr;
}

std::string value_hint(const Parameter& parameter)
{
    switch (parameter.type) {
    case Type::quantity:
        return parameter.unit == "1" ? "a plain number" : "such as \"1 " + parameter.unit + "\"";
    case Type::vector:
        return "a list of " + std::to_string(parameter.components) + " such as \"1 " + parameter.unit + "\"";
    case Type::choice:
    case Type::choice_list:
        return "of " + joined(parameter.choices);
    case Type::integer:
        return "a whole number";
    case Type::boolean:
        return "true or false";
    case Type::strength:
        return "true, false or a number";
    case Type::text:
    case Type::file:
        return "a text in quotes";
    case Type::text_list:
        return "a list of texts";
    case Type::time_window:
        return "such as [\"1 ms\", \"end\"]";
    case Type::any_quantity:
    case Type::by_level:
        return "a number with its unit";
    }
    return "";
}

double value_in_unit(const json& any_quantity, const std::string& unit, const Node& node, const std::string& key)
{
    const Dimension dimension{any_quantity.at("dimension").get<std::array<int, 6>>()};
    if (dimension != parse_unit(unit).dimension)
        refuse(node.position, key,
               dimension.none() ? "has no unit" : "has the unit " + dimension_text(dimension) + " instead of " + unit,
               expected(unit));
    return any_quantity.at("value");
}

} // namespace cupel
