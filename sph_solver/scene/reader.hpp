/// Reads a tree of values as its declaration says: units, bounds, defaults, and refusal of what is not declared.
#pragma once

#include "scene/declaration.hpp"
#include "scene/document.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace cupel
{

/// What a case file gives once it is read: the same layout as the file, all SI.
struct Reading
{
    nlohmann::json values;  ///< tables as objects; absent tables and absent optional keys are absent
    nlohmann::json assumed; ///< list of {key, value, unit, reason}
    nlohmann::json sources; ///< list of {key, source}
};

/// Throws CaseError with position, key, what is wrong and what to do. Unknown keys are refused before all else.
Reading read_declared(const Table& declaration, const Node& document);

/// The node at "time.end" or "body.0.radius", or the nearest one above it that exists.
const Node& node_at(const Node& document, const std::string& path);

} // namespace cupel
