/// One value of a case file as its declaration says: kind, unit, bounds.
#pragma once

#include "scene/declaration.hpp"
#include "scene/document.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace cupel
{

/// "laser" and "power" to "laser.power".
std::string below(const std::string& path, const std::string& key);

/// Throws CaseError unless the value is of that kind.
void require_kind(const Node& node, Node::Kind kind, const std::string& path, const std::string& remedy);

/// The value in SI. Throws CaseError with position, key, what is wrong and what to write.
nlohmann::json convert_value(const Parameter& parameter, const Node& node, const std::string& path);

/// How a value of this parameter is written, for messages.
std::string value_hint(const Parameter& parameter);

/// A value of Type::any_quantity as read: {"value", "dimension", "text"}; converted once its unit is known.
/// Throws CaseError where its dimension is not that of `unit`.
double value_in_unit(const nlohmann::json& any_quantity, const std::string& unit, const Node& node,
                     const std::string& key);

} // namespace cupel
