/// What the keys of a case must be to each other: data that the physics needs, geometry that can be filled.
#pragma once

#include "scene/document.hpp"

#include <nlohmann/json.hpp>

namespace cupel
{

/// Checks the values as read (reader.hpp) against each other. Throws CaseError at the place of the offending key.
void check_rules(const nlohmann::json& values, const Node& document);

/// Checks that need the spacing of the chosen level [m]. Throws CaseError.
void check_resolution(const nlohmann::json& values, const Node& document, const std::string& level);

/// Names of the materials of the bodies, each once, in their order.
std::vector<std::string> body_materials(const nlohmann::json& values);

/// Whether the values name a physics.
bool names_physics(const nlohmann::json& values, const std::string& physics);

} // namespace cupel
