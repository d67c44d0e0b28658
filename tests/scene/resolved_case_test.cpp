#include "temporary_case.hpp"

#include "scene/digest.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

namespace cupel
{
namespace
{

using testing::drop_case;
using ::testing::HasSubstr;
using testing::refusal;
using testing::replaced;
using testing::resolved;
using testing::TemporaryFolder;

std::string canonical(const std::string& name)
{
    return std::string(CUPEL_CASES_FOLDER) + "/" + name + "/case.toml";
}

class CanonicalCase : public ::testing::TestWithParam<const char*>
{};

TEST_P(CanonicalCase, ResolvesToTheTypedCase)
{
    const Case definition = read_case(canonical(GetParam()));
    EXPECT_EQ(definition.name, GetParam());
    EXPECT_GT(definition.spacing, 0);
    EXPECT_FALSE(definition.bodies.empty());
    EXPECT_TRUE(definition.surrounding);
    EXPECT_FALSE(definition.resolved.at("measures").empty());
    for (const auto& measure : definition.resolved.at("measures"))
        EXPECT_GT(measure.at("tolerance").get<double>(), 0) << measure;
}

TEST_P(CanonicalCase, HasFinerLevels)
{
    const double coarse = read_case(canonical(GetParam()), "coarse").spacing;
    const double medium = read_case(canonical(GetParam()), "medium").spacing;
    const double fine = read_case(canonical(GetParam()), "fine").spacing;
    EXPECT_LT(medium, coarse);
    EXPECT_LT(fine, medium);
}

TEST_P(CanonicalCase, NeedsNoNumericsOfItsOwn)
{
    const nlohmann::json numerics = resolve_case(canonical(GetParam()), {}).at("numerics");
    EXPECT_EQ(numerics, resolved(drop_case).at("numerics"));
}

INSTANTIATE_TEST_SUITE_P(Scene, CanonicalCase,
                         ::testing::Values("droplet_wetting", "marangoni_layer", "slm_track_100w", "slm_track_150w",
                                           "slm_track_200w"));

TEST(ResolvedCase, DropletHasThePapersElementCount)
{
    const Case definition = read_case(canonical("droplet_wetting"), "paper");
    double count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double across = (definition.domain.upper[axis] - definition.domain.lower[axis]) / definition.spacing;
        EXPECT_NEAR(across, std::round(across), 1e-9);
        count *= std::round(across);
    }
    EXPECT_EQ(count, 186184);
}

TEST(ResolvedCase, TracksDifferInPowerOnly)
{
    nlohmann::json weak = resolve_case(canonical("slm_track_100w"), {});
    nlohmann::json strong = resolve_case(canonical("slm_track_200w"), {});
    EXPECT_EQ(weak.at("laser").at("power"), 100.0);
    EXPECT_EQ(strong.at("laser").at("power"), 200.0);
    for (nlohmann::json* track : {&weak, &strong}) {
        for (const char* key : {"name", "title", "case_file", "hash", "paper"})
            track->erase(key);
        track->at("laser").erase("power");
    }
    EXPECT_EQ(weak, strong);
}

TEST(ResolvedCase, IsAllSIWithAnglesInRadians)
{
    const Case droplet = read_case(canonical("droplet_wetting"));
    EXPECT_DOUBLE_EQ(*droplet.material("oil").contact_angle, std::numbers::pi / 4);
    EXPECT_EQ(droplet.bodies.front().radius, 1e-3);
    const Case track = read_case(canonical("slm_track_150w"));
    EXPECT_EQ(track.laser->spot_radius, 8e-5);
    EXPECT_EQ(track.laser->absorptivity, 0.35);
    EXPECT_EQ(track.material("steel").latent_heat, 247e3);
}

TEST(ResolvedCase, ListsWhatIsAssumedWithItsReason)
{
    const nlohmann::json assumed = resolved(drop_case).at("assumed");
    ASSERT_EQ(assumed.size(), 1U);
    EXPECT_EQ(
        assumed[0],
        (nlohmann::json{{"key", "material.oil.viscosity"}, {"value", 0.05}, {"unit", "Pa s"}, {"reason", "a guess"}}));
    EXPECT_EQ(resolved(drop_case).at("sources")[0].at("source"), "a table");
}

TEST(ResolvedCase, IsTheSameTextEachTime)
{
    const TemporaryFolder folder;
    const std::string file = folder.write("case.toml", drop_case);
    EXPECT_EQ(resolve_case(file, {}).dump(), resolve_case(file, {}).dump());
}

TEST(ResolvedCase, HashFollowsTheContentAndNotThePlace)
{
    const TemporaryFolder folder;
    const auto hash = [&](const std::string& name, const std::string& content) {
        return resolve_case(folder.write(name, content), {}).at("hash").get<std::string>();
    };
    EXPECT_EQ(hash("one/drop.toml", drop_case), hash("other/drop.toml", "# a comment\n" + drop_case));
    EXPECT_NE(hash("one/drop.toml", drop_case), hash("other/drop.toml", replaced(drop_case, "0.5 mm", "0.6 mm")));
    EXPECT_EQ(hash("one/drop.toml", drop_case), hash("other/drop.toml", replaced(drop_case, "0.5 mm", "500 um")));
}

TEST(ResolvedCase, HashFollowsTheBedsContent)
{
    const TemporaryFolder folder;
    const std::string head = "x_m,y_m,z_m,radius_m\n";
    const auto hash = [&](const std::string& rows) {
        const std::string bed = folder.write("bed.csv", head + rows);
        return resolve_case(canonical("slm_track_150w"), {"coarse", {"body.1.file=" + bed}, true})
            .at("hash")
            .get<std::string>();
    };
    EXPECT_NE(hash("8e-4,0,2e-5,2e-5\n"), hash("8e-4,0,2e-5,1.9e-5\n"));
}

TEST(ResolvedCase, HasNullWhereAPhysicsIsNotNamed)
{
    const nlohmann::json values = resolve_case(canonical("droplet_wetting"), {});
    EXPECT_TRUE(values.at("laser").is_null());
    EXPECT_TRUE(values.at("powder").is_null());
    const Case without_laser =
        read_case(canonical("slm_track_150w"), "coarse", {"physics=[\"flow\", \"heat\", \"melting\"]"});
    EXPECT_FALSE(without_laser.laser);
    EXPECT_FALSE(without_laser.requires_physics("laser"));
    EXPECT_TRUE(without_laser.requires_physics("melting"));
    EXPECT_THROW(static_cast<void>(without_laser.requires_physics("lasser")), CaseError);
}

TEST(ResolvedCase, PapersFormulationIsItsSetOfRemedies)
{
    const nlohmann::json numerics = resolved(drop_case, {"numerics.formulation=paper"}).at("numerics");
    EXPECT_EQ(numerics.at("artificial_stress"), 0.2);
    EXPECT_EQ(numerics.at("shifting"), 0.0);
    EXPECT_EQ(numerics.at("surface_load"), "continuum_force");
    EXPECT_EQ(numerics.at("contact_line_force"), true);
    const nlohmann::json chosen =
        resolved(drop_case, {"numerics.formulation=paper", "numerics.artificial_stress=0.1"}).at("numerics");
    EXPECT_EQ(chosen.at("artificial_stress"), 0.1);
}

TEST(Measures, WindowIsCutAtTheEndOfTheRun)
{
    const nlohmann::json measure =
        resolve_case(canonical("slm_track_150w"), {"coarse", {"time.end=1 ms"}, true}).at("measures")[0];
    EXPECT_EQ(measure.at("between"), nlohmann::json::array({1e-3, 1e-3}));
}

TEST(Measures, LastSnapshotIsAWindow)
{
    const auto window = [](const std::string& between) {
        return resolved(drop_case + "[[measure]]\nname = \"base_radius\"\nbetween = " + between + "\n")
            .at("measures")[0]
            .at("between");
    };
    EXPECT_EQ(window("[\"end\", \"end\"]"), nlohmann::json::array({1e-3, 1e-3}));
    EXPECT_THAT(refusal(drop_case + "[[measure]]\nname = \"base_radius\"\nbetween = [\"end\", \"1 s\"]\n"),
                HasSubstr("is no pair of times"));
}

TEST(Measures, ToleranceTellsTheMetric)
{
    const nlohmann::json measures = resolve_case(canonical("droplet_wetting"), {}).at("measures");
    EXPECT_EQ(measures[0].at("metric"), "absolute"); // 5 deg
    EXPECT_DOUBLE_EQ(measures[0].at("tolerance").get<double>(), 5 * std::numbers::pi / 180);
    EXPECT_EQ(measures[1].at("metric"), "relative"); // 6 %
    EXPECT_EQ(measures[1].at("tolerance"), 0.06);
}

TEST(Measures, ThatCannotBeJudgedAreRefused)
{
    const auto with = [](const std::string& lines) {
        return refusal(drop_case + "[[measure]]\nbetween = [\"0 s\", \"end\"]\n" + lines);
    };
    EXPECT_THAT(with("name = \"base_radios\"\n"), HasSubstr("did you mean 'base_radius'?"));
    EXPECT_THAT(with("name = \"base_radius\"\ntolerance = \"1 %\"\n"), HasSubstr("there is no reference to judge by"));
    EXPECT_THAT(
        with("name = \"base_radius\"\nreference = { kind = \"exact\", value = \"1 s\" }\ntolerance = \"1 %\"\n"),
        HasSubstr("has the unit s instead of m"));
    EXPECT_THAT(
        with("name = \"base_radius\"\nreference = { kind = \"exact\", value = \"1 m\" }\ntolerance = \"1 s\"\n"),
        HasSubstr("measure.0.tolerance: has the unit s instead of m"));
    EXPECT_THAT(with("name = \"bead_height\"\nreference = { kind = \"exact\" }\n"),
                HasSubstr("measure.0.reference.value: is missing, 'bead_height' cannot work one out of the case"));
    EXPECT_THAT(with("name = \"base_radius\"\nreference = { kind = \"exact\", solver = \"sph\" }\n"),
                HasSubstr("has no meaning with kind = \"exact\""));
    EXPECT_THAT(with("name = \"base_radius\"\nreference = { kind = \"paper\" }\n"), HasSubstr("value: is missing"));
    EXPECT_THAT(with("name = \"profile_error\"\nreference = { kind = \"exact\", value = 0 }\ntolerance = 0.1\n"),
                HasSubstr("measure.0.metric: is missing"));
    EXPECT_THAT(with("name = \"profile_error\"\nreference = { kind = \"exact\", value = 0 }\ntolerance = 0.1\nmetric = "
                     "\"relative\"\n"),
                HasSubstr("a share of a reference that is zero"));
    EXPECT_EQ(with("name = \"base_radius\"\n"), "");
}

nlohmann::json measure_with(const std::string& lines, const std::string& level = "coarse")
{
    const TemporaryFolder folder;
    const std::string file = folder.write("case.toml", replaced(drop_case, "resolution.coarse = \"10 um\"",
                                                                "resolution = { coarse = \"10 um\", medium = \"9 um\", "
                                                                "fine = \"8 um\", paper = \"7 um\" }") +
                                                           "[[measure]]\nbetween = [\"0 s\", \"end\"]\n" + lines);
    return resolve_case(file, {level, {}, true}).at("measures")[0];
}

TEST(Measures, WorkOutTheirOwnExactReference)
{
    const nlohmann::json radius =
        measure_with("name = \"base_radius\"\nreference = { kind = \"exact\" }\ntolerance = \"1 %\"\n");
    EXPECT_EQ(radius.at("reference").at("kind"), "exact");
    EXPECT_TRUE(radius.at("reference").at("value").is_null());
    EXPECT_EQ(radius.at("metric"), "relative");
}

TEST(Measures, ThatAreErrorsThemselvesAreJudgedAsTheyAre)
{
    const nlohmann::json error =
        measure_with("name = \"profile_error\"\nreference = { kind = \"exact\" }\ntolerance = \"1 %\"\n");
    EXPECT_EQ(error.at("metric"), "absolute");
    EXPECT_EQ(error.at("tolerance"), 0.01);
}

TEST(Measures, LevelThatIsNotNamedHasTheToleranceOfTheNextCoarserOne)
{
    const std::string lines = "name = \"base_radius\"\nreference = { kind = \"exact\" }\n"
                              "tolerance = { medium = \"2 %\", paper = \"1 %\" }\n";
    EXPECT_TRUE(measure_with(lines, "coarse").at("tolerance").is_null());
    EXPECT_EQ(measure_with(lines, "medium").at("tolerance"), 0.02);
    EXPECT_EQ(measure_with(lines, "fine").at("tolerance"), 0.02);
    EXPECT_EQ(measure_with(lines, "paper").at("tolerance"), 0.01);
}

TEST(Measures, ToleranceOfALevelIsCheckedAtEveryLevel)
{
    const auto with = [](const std::string& tolerance) {
        return refusal(drop_case +
                       "[[measure]]\nbetween = [\"0 s\", \"end\"]\nname = \"base_radius\"\n"
                       "reference = { kind = \"exact\" }\ntolerance = " +
                       tolerance + "\n");
    };
    EXPECT_THAT(with("{ fine = \"-1 %\" }"), HasSubstr("case.toml:26:22: measure.0.tolerance: is not above zero"));
    EXPECT_THAT(with("{ fone = \"1 %\" }"), HasSubstr("tolerance.fone: there is no such level"));
    EXPECT_THAT(with("{ coarse = \"1 %\", fine = \"1 m\" }"), HasSubstr("has the unit m instead of 1"));
    EXPECT_THAT(with("{}"), HasSubstr("names no level"));
    EXPECT_EQ(with("{ value = \"1 %\", source = \"a table\" }"), "");
}

TEST(TypedCase, RefusesJsonThatIsNoResolvedCase)
{
    EXPECT_THROW(case_from_resolved(nlohmann::json::object()), CaseError);
    nlohmann::json values = resolved(drop_case);
    values["schema"] = 99;
    EXPECT_THROW(case_from_resolved(values), CaseError);
    values = resolved(drop_case);
    values.at("bodies")[0]["radius"] = "large";
    EXPECT_THROW(case_from_resolved(values), CaseError);
    const TemporaryFolder folder;
    EXPECT_THROW(read_resolved_case(folder.write("cut.json", "{\"schema\": 1,")), CaseError);
    EXPECT_THROW(read_resolved_case("/nowhere.json"), CaseError);
}

TEST(TypedCase, LaserRunsItsPathAtItsSpeed)
{
    const Laser laser = *read_case(canonical("slm_track_150w")).laser;
    EXPECT_DOUBLE_EQ(laser.off_time(), 1e-3 / 0.15);
    EXPECT_DOUBLE_EQ(laser.position(2e-3)[0], 3e-4 + 0.15 * 2e-3);
    EXPECT_EQ(laser.position(1.0), laser.to);
    Laser resting = laser;
    resting.to = resting.from;
    EXPECT_EQ(resting.position(1.0), resting.from);
    EXPECT_TRUE(std::isinf(resting.off_time()));
}

TEST(TypedCase, FrozenTemperatureIsLinearFromTheLowerCorner)
{
    const Case layer = read_case(canonical("marangoni_layer"));
    EXPECT_DOUBLE_EQ(layer.initial_temperature({0, 0, 0}), 300);
    EXPECT_DOUBLE_EQ(layer.initial_temperature({6e-3, 0, 1e-3}), 306);
}

TEST(RoundWalls, AreRefusedWhereTheyMeanNothing)
{
    const std::string open = replaced(
        drop_case,
        R"(boundaries = { x_min.kind = "wall", x_max.kind = "wall", z_min.kind = "symmetry", z_max.kind = "open" })",
        R"(boundaries = { x_min.kind = "open", x_max.kind = "open", z_min.kind = "open", z_max.kind = "open" }
round_walls = { center = ["0 mm", "0 mm", "0 mm"], inner_radius = "0.4 mm" })");
    const auto with = [&](const std::string& part, const std::string& other) {
        return refusal(replaced(open, part, other));
    };
    EXPECT_EQ(refusal(open), "");
    EXPECT_THAT(with(", inner_radius = \"0.4 mm\"", ""), HasSubstr("round_walls: names no wall"));
    EXPECT_THAT(with("inner_radius = \"0.4 mm\"", "inner_radius = \"0.4 mm\", outer_radius = \"0.3 mm\""),
                HasSubstr("outer_radius: leaves nothing between the walls"));
    EXPECT_THAT(with("x_min.kind = \"open\"", "x_min.kind = \"wall\""),
                HasSubstr("domain.boundaries.x_min.kind: is a side of its own beside round walls"));
    EXPECT_THAT(with("state = \"liquid\"", "state = \"solid\""), HasSubstr("body: is not one sphere of liquid"));
    EXPECT_THAT(with("center = [\"0 mm\", \"0 mm\"", "center = [\"0 mm\", \"1 mm\""), HasSubstr("plane y = 0"));
    const Case definition = case_from_resolved(resolved(open));
    ASSERT_TRUE(definition.domain.round_walls);
    EXPECT_DOUBLE_EQ(*definition.domain.round_walls->inner_radius, 4e-4);
    EXPECT_FALSE(definition.domain.round_walls->outer_radius);
}

TEST(Digest, IsSha256)
{
    // FIPS 180-2, appendix B.1
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

} // namespace
} // namespace cupel
