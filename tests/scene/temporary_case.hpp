/// Case files written for one test into a folder that goes away with it.
#pragma once

#include "scene/resolve.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace cupel::testing
{

class TemporaryFolder
{
public:
    TemporaryFolder()
    {
        std::string pattern = (std::filesystem::temp_directory_path() / "cupel_scene_XXXXXX").string();
        if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder can be made");
        path_ = pattern;
    }
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    /// Writes a file below the folder and returns its path.
    std::string write(const std::string& name, const std::string& content) const
    {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << content;
        return file.string();
    }

private:
    std::filesystem::path path_;
};

/// A small whole case: a drop in two dimensions. Line 17, column 9 is the radius.
inline const std::string drop_case = R"(title = "A drop"
dimensions = 2
physics = ["flow", "surface_tension"]
resolution.coarse = "10 um"
[material.oil]
density = "900 kg/m^3"
viscosity = { value = "0.05 Pa s", assumed = "a guess" }
surface_tension = { value = "0.05 N/m", source = "a table" }
[domain]
lower = ["-1 mm", "0 mm", "-1 mm"]
upper = ["1 mm", "0 mm", "1 mm"]
boundaries = { x_min.kind = "wall", x_max.kind = "wall", z_min.kind = "symmetry", z_max.kind = "open" }
[[body]]
shape = "sphere"
material = "oil"
center = ["0 mm", "0 mm", "0 mm"]
radius = "0.5 mm"
state = "liquid"
[time]
end = "1 ms"
output_interval = "0.1 ms"
)";

/// `text` with the first `old_part` replaced; throws where it is not there, so that no test changes nothing.
inline std::string replaced(std::string text, const std::string& old_part, const std::string& new_part)
{
    const std::size_t place = text.find(old_part);
    if (place == std::string::npos) throw std::logic_error("'" + old_part + "' is not in the text");
    return text.replace(place, old_part.size(), new_part);
}

/// The message with which a case file is refused, "" where it is taken; the folder's name is taken out.
inline std::string refusal(const std::string& content, const std::vector<std::string>& overrides = {},
                           const std::string& level = "coarse")
{
    const TemporaryFolder folder;
    const std::string file = folder.write("case.toml", content);
    try {
        resolve_case(file, {level, overrides, true});
    }
    catch (const CaseError& error) {
        const std::string prefix = std::filesystem::path(file).parent_path().string() + "/";
        std::string message = error.what();
        for (std::size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
            message.erase(at, prefix.size());
        return message;
    }
    return "";
}

inline nlohmann::json resolved(const std::string& content, const std::vector<std::string>& overrides = {})
{
    const TemporaryFolder folder;
    return resolve_case(folder.write("case.toml", content), {"coarse", overrides, true});
}

} // namespace cupel::testing
