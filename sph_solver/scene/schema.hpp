/// What the declarations say, for editors (JSON schema) and for people (Markdown tables).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace cupel
{

/// JSON schema (draft 2020-12) of a case file; values that a base file supplies are not demanded of the file itself.
nlohmann::json case_schema();

/// Every parameter with its unit, bounds, default and help, as Markdown.
std::string parameter_reference();

} // namespace cupel
