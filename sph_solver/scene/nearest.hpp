/// The nearest known name to a mistyped one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cupel
{

/// Letters to insert, delete, replace or swap with a neighbour to come from one text to the other.
std::size_t edit_distance(std::string_view one, std::string_view other);

/// The known name at the smallest edit distance, or "" where none is near enough to be meant (a third of its length,
/// at least one letter). Of equally near ones the first.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// " (did you mean 'x'?)", or "" where nothing is near.
std::string suggestion(std::string_view name, const std::vector<std::string>& known);

/// "a, b, c"
std::string joined(const std::vector<std::string>& names);

} // namespace cupel
