/// Names of the physics that a case can require, and which others each of them needs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cupel
{

/// Version of the resolved case's layout.
inline constexpr int resolved_schema_version = 1;

struct PhysicsDeclaration
{
    std::string name;
    std::vector<std::string> needs; ///< physics without which this one has no meaning
    std::string help;
};

/// All of them, in the order in which a resolved case lists them.
const std::vector<PhysicsDeclaration>& physics_declarations();

bool is_physics(std::string_view name);

} // namespace cupel
