/// From a case file to the resolved case: one JSON document, all SI, all defaults filled, that both solvers read.
#pragma once

#include "scene/case.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cupel
{

struct ResolveOptions
{
    std::string level = "coarse";
    std::vector<std::string> overrides{}; ///< "key.path=value"
    bool require_files = true;            ///< false: a bed that is still to be made may be missing
    std::string variation{};              ///< of the file's [sweep]; empty where it has none
};

/// Reads, checks and resolves a case file. The same file, materials, bed, level and overrides give the same text.
/// Throws CaseError "FILE:LINE:COLUMN: key: what; what to do" for anything that it does not understand.
nlohmann::json resolve_case(const std::string& path, const ResolveOptions& options);

/// The same as typed values.
Case read_case(const std::string& path, const std::string& level = "coarse",
               const std::vector<std::string>& overrides = {}, const std::string& variation = "");

/// What a case file holds, whatever the level: {"tier", "members": [{"name", "variation", "title", "levels"}]}. A file
/// with a [sweep] has a member a variation, named CASE_VARIATION; another one has itself, with variation null.
/// Throws CaseError where the file cannot be read.
nlohmann::json summarize_case(const std::string& path);

} // namespace cupel
