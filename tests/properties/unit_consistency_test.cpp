/// The answer of a case does not depend on the units in which it is asked: metres or microns, kilograms or grams.
///
/// Each case is run twice for some steps, as it is and in other units of length, mass, time and temperature, and the
/// two are compared in the same units. A number with a dimension that is hidden in the code (a smallest length, a speed
/// that is "small") is not scaled with the rest and shows.
#include "integrators/simulation.hpp"
#include "scene/place_particles.hpp"
#include "scene/resolve.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "scaled_case.hpp"

namespace cupel
{
namespace
{

using properties::ScaledCase;
using properties::UnitScale;

/// Units that differ by much in every quantity: a length counts 16² times as much, a pressure 16.
constexpr UnitScale other_units{2, 1, -1};

std::vector<std::string> case_files()
{
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(CUPEL_CASES_FOLDER))
        if (const auto file = entry.path() / "case.toml"; std::filesystem::exists(file)) files.push_back(file.string());
    std::sort(files.begin(), files.end());
    return files;
}

Simulation run(const nlohmann::json& resolved, int steps)
{
    Simulation simulation(place_particles(case_from_resolved(resolved)));
    simulation.start();
    const double end = simulation.scene().definition.time.end;
    for (int step = 0; step < steps; ++step)
        simulation.step(end - simulation.time());
    return simulation;
}

/// The greatest difference of a field in the two runs, over its greatest magnitude.
class Comparison
{
public:
    void add(double value, double scaled)
    {
        difference_ = std::max(difference_, std::abs(value - scaled));
        magnitude_ = std::max(magnitude_, std::abs(value));
        finite_ = finite_ && std::isfinite(value) && std::isfinite(scaled);
    }
    double relative() const
    {
        return !finite_         ? std::numeric_limits<double>::infinity()
               : magnitude_ > 0 ? difference_ / magnitude_
                                : difference_;
    }

private:
    double difference_ = 0, magnitude_ = 0;
    bool finite_ = true;
};

void expect_same(const Simulation& one, const Simulation& other, const UnitScale& scale, const std::string& name)
{
    // Powers of two scale exactly, and so do sums, products and roots of what they scale: what is left are powers and
    // exponentials, whose arguments have no units.
    constexpr double round_off = 1e-11;
    EXPECT_NEAR(other.time() / scale.factor("s") / one.time(), 1.0, round_off) << name;
    const Particles& a = one.particles();
    const Particles& b = other.particles();
    ASSERT_EQ(a.count(), b.count()) << name;
    const double metre = scale.factor("m"), speed = scale.factor("m/s"), density = scale.factor("kg/m^3");
    Comparison positions, velocities, densities, temperatures;
    for (Index identity = 0; identity < a.count(); ++identity) {
        const Index i = a.place_of(identity), j = b.place_of(identity);
        const auto add = [](Comparison& comparison, const Vector& p, const Vector& q) {
            comparison.add(p.x, q.x);
            comparison.add(p.y, q.y);
            comparison.add(p.z, q.z);
        };
        add(positions, a.position[i], (1.0 / metre) * b.position[j]);
        add(velocities, a.velocity[i], (1.0 / speed) * b.velocity[j]);
        densities.add(a.density[i], b.density[j] / density);
        if (a.has("temperature"))
            temperatures.add(a.scalar("temperature")[i], b.scalar("temperature")[j] / scale.factor("K"));
    }
    EXPECT_LT(positions.relative(), round_off) << name << ": position";
    EXPECT_LT(velocities.relative(), round_off) << name << ": velocity";
    EXPECT_LT(densities.relative(), round_off) << name << ": density";
    EXPECT_LT(temperatures.relative(), round_off) << name << ": temperature";
}

class Units : public ::testing::Test
{
protected:
    Units() : folder_(std::filesystem::temp_directory_path() / ("cupel_units_" + std::to_string(::getpid())))
    {
        std::filesystem::create_directories(folder_);
    }
    ~Units() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path folder_;
};

class UnitsOfCase : public Units, public ::testing::WithParamInterface<std::string>
{};

TEST_P(UnitsOfCase, AreAMatterOfChoice)
{
    const nlohmann::json summary = summarize_case(GetParam());
    for (const auto& member : summary.at("members")) {
        const std::string variation = member.at("variation").is_null() ? "" : member.at("variation");
        const nlohmann::json resolved = resolve_case(GetParam(), {"coarse", {}, true, variation});
        const nlohmann::json scaled = ScaledCase(other_units, folder_)(resolved);
        const int steps = resolved.at("dimensions") == 2 ? 40 : 4;
        expect_same(run(resolved, steps), run(scaled, steps), other_units, resolved.at("name"));
    }
}

/// A track of which a few steps show only its heat: coarser and warmer than its levels, so that a pool melts, flows,
/// boils and freezes within a second of computing.
TEST_F(Units, OfATrackThatMeltsAreAMatterOfChoice)
{
    const std::string file = CUPEL_CASES_FOLDER "/slm_track_150w/case.toml";
    const nlohmann::json resolved = resolve_case(
        file, {"coarse", {"resolution.coarse=40 um", "initial.temperature=1600 K", "laser.power=400 W"}, true, ""});
    const Simulation one = run(resolved, 600);
    EXPECT_GT(one.neighbourhood().moving_particles().size(), 20U);
    expect_same(one, run(ScaledCase(other_units, folder_)(resolved), 600), other_units, "a track that melts");
}

INSTANTIATE_TEST_SUITE_P(Each, UnitsOfCase, ::testing::ValuesIn(case_files()), [](const auto& info) {
    return std::filesystem::path(info.param).parent_path().filename().string();
});

} // namespace
} // namespace cupel
