/// Every case of the suite can be turned into particles. What they then do is a matter of running them.
#include "scene/place_particles.hpp"
#include "scene/resolve.hpp"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

namespace cupel
{
namespace
{

/// Lattice points beyond which a level is not placed here: it takes long and differs in nothing but the spacing.
constexpr double most_points = 300'000;

std::vector<std::string> case_files()
{
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(CUPEL_CASES_FOLDER))
        if (const auto file = entry.path() / "case.toml"; std::filesystem::exists(file)) files.push_back(file.string());
    std::sort(files.begin(), files.end());
    return files;
}

double lattice_points(const Case& definition)
{
    double points = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (axis != 1 || definition.dimensions == 3)
            points *= (definition.domain.upper[axis] - definition.domain.lower[axis]) / definition.spacing;
    return points;
}

class PlacementOfCase : public ::testing::TestWithParam<std::string>
{};

TEST_P(PlacementOfCase, GivesParticlesInsideTheDomainAtEveryLevel)
{
    const nlohmann::json summary = summarize_case(GetParam());
    for (const auto& member : summary.at("members")) {
        const std::string variation = member.at("variation").is_null() ? "" : member.at("variation");
        for (const std::string level : member.at("levels")) {
            const Case definition = read_case(GetParam(), level, {}, variation);
            if (lattice_points(definition) > most_points) continue;
            const Scene scene = place_particles(definition);
            double volume = 0;
            for (Index i = 0; i < scene.particles->count(); ++i) {
                if (scene.particles->kind[std::size_t(i)] == Kind::wall) continue;
                volume += scene.particles->volume[i];
                const Vector p = scene.particles->position[i];
                ASSERT_TRUE(p.x > definition.domain.lower[0] && p.x < definition.domain.upper[0] &&
                            p.z > definition.domain.lower[2] && p.z < definition.domain.upper[2])
                    << definition.name << " " << level;
            }
            EXPECT_GT(volume, 0) << definition.name << " " << level;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Each, PlacementOfCase, ::testing::ValuesIn(case_files()), [](const auto& info) {
    return std::filesystem::path(info.param).parent_path().filename().string();
});

} // namespace
} // namespace cupel
