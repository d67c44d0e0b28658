#include "scene/nearest.hpp"

#include <algorithm>

namespace cupel
{

std::size_t edit_distance(std::string_view one, std::string_view other)
{
    const std::size_t rows = one.size() + 1;
    const std::size_t columns = other.size() + 1;
    std::vector<std::size_t> table(rows * columns);
    const auto at = [&](std::size_t row, std::size_t column) -> std::size_t& { return table[row * columns + column]; };
    for (std::size_t row = 0; row < rows; ++row)
        at(row, 0) = row;
    for (std::size_t column = 0; column < columns; ++column)
        at(0, column) = column;
    for (std::size_t row = 1; row < rows; ++row) {
        for (std::size_t column = 1; column < columns; ++column) {
            const std::size_t replaced = at(row - 1, column - 1) + (one[row - 1] == other[column - 1] ? 0 : 1);
            at(row, column) = std::min({replaced, at(row - 1, column) + 1, at(row, column - 1) + 1});
            const bool swapped =
                row > 1 && column > 1 && one[row - 1] == other[column - 2] && one[row - 2] == other[column - 1];
            if (swapped) at(row, column) = std::min(at(row, column), at(row - 2, column - 2) + 1);
        }
    }
    return at(rows - 1, columns - 1);
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& known)
{
    std::string best;
    std::size_t best_distance = 0;
    for (const std::string& candidate : known) {
        const std::size_t distance = edit_distance(name, candidate);
        const std::size_t allowed = std::max<std::size_t>(1, std::max(candidate.size(), name.size()) / 3);
        if (distance <= allowed && distance < std::max(candidate.size(), name.size()) &&
            (best.empty() || distance < best_distance))
        {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& known)
{
    const std::string nearest = nearest_name(name, known);
    return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
}

std::string joined(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

} // namespace cupel
