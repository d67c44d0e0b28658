#include "scene/powder_bed.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>

namespace cupel
{

namespace
{

constexpr const char* column_names = "x_m,y_m,z_m,radius_m";

[[noreturn]] void refuse_line(const std::string& path, std::size_t line, std::size_t column, const std::string& what)
{
    throw CaseError(path + ":" + std::to_string(line) + ":" + std::to_string(column) + ": powder bed: " + what +
                    "; make the bed again with ./cupel bed CASE");
}

} // namespace

std::vector<Grain> read_powder_bed(const std::string& path)
{
    std::ifstream stream(path);
    if (!stream) refuse_line(path, 1, 1, "the file is missing or cannot be read");
    std::vector<Grain> grains;
    bool named = false;
    std::string line;
    for (std::size_t number = 1; std::getline(stream, line); ++number) {
        if (line.empty() || line.front() == '#') continue;
        if (!named) {
            if (line != column_names) refuse_line(path, number, 1, std::string("the columns are not ") + column_names);
            named = true;
            continue;
        }
        std::array<double, 4> values{};
        const char* const begin = line.data();
        const char* const end = begin + line.size();
        const char* place = begin;
        for (std::size_t index = 0; index < values.size(); ++index) {
            const auto [after, problem] = std::from_chars(place, end, values[index]);
            const bool ends_well = index + 1 < values.size() ? after != end && *after == ',' : after == end;
            if (problem != std::errc{} || !ends_well || !std::isfinite(values[index]))
                refuse_line(path, number, static_cast<std::size_t>(place - begin) + 1, "here should stand a number");
            place = after + 1;
        }
        if (values[3] <= 0) refuse_line(path, number, 1, "the radius is not above zero");
        grains.push_back({{values[0], values[1], values[2]}, values[3]});
    }
    if (!named) refuse_line(path, 1, 1, std::string("the line of column names ") + column_names + " is missing");
    return grains;
}

} // namespace cupel
