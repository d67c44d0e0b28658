#include "temporary_case.hpp"

#include "scene/nearest.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace cupel
{
namespace
{

using ::testing::AllOf;
using testing::drop_case;
using ::testing::HasSubstr;
using testing::refusal;
using testing::replaced;
using testing::resolved;
using ::testing::StartsWith;
using testing::TemporaryFolder;

TEST(CaseFile, IsTakenAsItStands)
{
    EXPECT_EQ(refusal(drop_case), "");
}

TEST(CaseFile, UnknownKeyNamesLineAndNearestKey)
{
    EXPECT_EQ(refusal(replaced(drop_case, "radius =", "radios =")),
              "case.toml:17:1: body.0.radios: unknown key; correct it (did you mean 'radius'?)");
    EXPECT_EQ(refusal(replaced(drop_case, "[time]", "[tyme]")),
              "case.toml:19:2: tyme: unknown key; correct it (did you mean 'time'?)");
}

TEST(CaseFile, UnknownKeyWithoutNeighbourListsWhatThereIs)
{
    EXPECT_THAT(
        refusal(replaced(drop_case, "radius =", "colour =")),
        AllOf(StartsWith("case.toml:17:1: body.0.colour: unknown key"), HasSubstr("use one of: shape, material")));
}

TEST(CaseFile, WrongUnitNamesPlaceAndExpectedUnit)
{
    EXPECT_EQ(
        refusal(replaced(drop_case, "\"0.5 mm\"", "\"0.5 N\"")),
        "case.toml:17:10: body.0.radius: has the unit kg m/s^2 instead of m; write a number with a unit of the kind m, "
        "such as \"1 m\"");
}

TEST(CaseFile, MissingUnitIsRefused)
{
    EXPECT_THAT(refusal(replaced(drop_case, "\"0.5 mm\"", "0.5")),
                StartsWith("case.toml:17:10: body.0.radius: has no unit"));
    EXPECT_THAT(refusal(replaced(drop_case, "\"0.5 mm\"", "\"0.5\"")), HasSubstr("has no unit"));
}

TEST(CaseFile, NegativeDensityIsOutOfBounds)
{
    EXPECT_EQ(refusal(replaced(drop_case, "\"900 kg/m^3\"", "\"-900 kg/m^3\"")),
              "case.toml:6:11: material.oil.density: is -900.0 kg/m^3; it must be above 0.0 kg/m^3");
}

TEST(CaseFile, NotANumberAndInfinityAreRefused)
{
    EXPECT_THAT(refusal(drop_case + "[numerics]\nskin = nan\n"), HasSubstr("numerics.skin: is not a finite number"));
    EXPECT_THAT(refusal(drop_case + "[numerics]\nsound_speed_factor = inf\n"), HasSubstr("is not a finite number"));
}

TEST(CaseFile, MissingRequiredKeyNamesItsTable)
{
    EXPECT_THAT(refusal(replaced(drop_case, "radius = \"0.5 mm\"\n", "")),
                StartsWith("case.toml:13:1: body.0.radius: is missing; add it"));
    EXPECT_THAT(refusal(""), HasSubstr("case.toml:1:1: "));
}

TEST(CaseFile, KeyOfAnotherShapeIsRefused)
{
    EXPECT_THAT(refusal(replaced(drop_case, "radius =", "file = \"bed.csv\"\nradius =")),
                StartsWith("case.toml:17:1: body.0.file: has no meaning with shape = \"sphere\""));
}

TEST(CaseFile, SyntaxErrorNamesLineAndColumn)
{
    EXPECT_THAT(refusal(replaced(drop_case, "[time]", "[time")), StartsWith("case.toml:19:6: TOML: "));
}

TEST(CaseFile, EveryLineOfARefusalIsOneLine)
{
    for (const std::string& content : {std::string(""), std::string("\x01"), std::string("base = \"no.toml\""),
                                       replaced(drop_case, "\"oil\"", "\"\\n\"")})
        EXPECT_EQ(refusal(content).find('\n'), std::string::npos) << refusal(content);
}

/// Whatever is done to a case file, it is taken or refused in one line: nothing else is thrown, nothing breaks.
TEST(CaseFileProperty, DamagedFileIsTakenOrRefusedInOneLine)
{
    const std::string alphabet = "[]{}=\"'.,#\n 0-9eaK/^()\\";
    std::mt19937 generator(7);
    int refused = 0;
    for (int trial = 0; trial < 400; ++trial) {
        std::string damaged = drop_case;
        for (int times = 0; times < 1 + trial % 3; ++times) {
            const std::size_t place = generator() % damaged.size();
            const std::size_t length = 1 + generator() % 6;
            if (generator() % 2 == 0)
                damaged.erase(place, length);
            else
                damaged[place] = alphabet[generator() % alphabet.size()];
        }
        const std::string message = refusal(damaged);
        refused += message.empty() ? 0 : 1;
        EXPECT_EQ(message.find('\n'), std::string::npos) << damaged;
    }
    EXPECT_GT(refused, 200); // most damage shows
}

TEST(CaseFile, MissingFileIsRefused)
{
    EXPECT_THROW(resolve_case("/nowhere/case.toml", {}), CaseError);
    EXPECT_THROW(resolve_case("/", {}), CaseError);
}

TEST(CaseFile, MaterialThatIsNotDeclaredNamesTheNearest)
{
    EXPECT_THAT(refusal(replaced(drop_case, "material = \"oil\"", "material = \"oill\"")),
                AllOf(HasSubstr("body.0.material: there is no [material.oill]"), HasSubstr("did you mean 'oil'?")));
}

TEST(CaseFile, UnknownMaterialFileNamesTheNearest)
{
    EXPECT_THAT(refusal(replaced(drop_case, "[material.oil]\n", "[material.oil]\nuse = \"304\"\n")),
                AllOf(StartsWith("case.toml:6:7: material.oil.use: there is no material file"),
                      HasSubstr("did you mean '304L'?")));
}

TEST(CaseFile, LevelThatTheCaseLacksIsRefused)
{
    EXPECT_THAT(refusal(drop_case, {}, "fine"), AllOf(HasSubstr("no level 'fine'"), HasSubstr("take one of: coarse")));
    EXPECT_THAT(refusal(drop_case, {}, "corse"), HasSubstr("did you mean 'coarse'?"));
}

TEST(CaseFile, ErrorInABaseFileNamesTheBaseFile)
{
    const TemporaryFolder folder;
    folder.write("common/base.toml", replaced(drop_case, "radius =", "radios ="));
    const std::string file = folder.write("drop/case.toml", "base = \"../common/base.toml\"\n");
    try {
        resolve_case(file, {});
        FAIL() << "the case was taken";
    }
    catch (const CaseError& error) {
        EXPECT_THAT(error.what(), HasSubstr("common/base.toml:17:1: body.0.radios"));
    }
}

TEST(CaseFile, LiesOverItsBaseKeyByKey)
{
    const TemporaryFolder folder;
    folder.write("base.toml", drop_case);
    const std::string file = folder.write("case.toml", "base = \"base.toml\"\n[time]\nend = \"2 ms\"\n");
    const nlohmann::json values = resolve_case(file, {});
    EXPECT_EQ(values.at("time").at("end"), 2e-3);
    EXPECT_EQ(values.at("time").at("output_interval"), 1e-4);
}

TEST(CaseFile, BasesInACircleAreRefused)
{
    const TemporaryFolder folder;
    folder.write("base.toml", "base = \"case.toml\"\n");
    const std::string file = folder.write("case.toml", "base = \"base.toml\"\n");
    EXPECT_THROW(resolve_case(file, {}), CaseError);
}

TEST(CaseFile, OverrideLiesOverTheFile)
{
    EXPECT_EQ(resolved(drop_case, {"time.end=2 ms"}).at("time").at("end"), 2e-3);
    EXPECT_EQ(resolved(drop_case, {"time.end=\"2 ms\""}).at("time").at("end"), 2e-3);
    EXPECT_EQ(resolved(drop_case, {"body.0.radius=0.25 mm"}).at("bodies")[0].at("radius"), 2.5e-4);
    EXPECT_EQ(resolved(drop_case, {"numerics.shifting=false"}).at("numerics").at("shifting"), 0.0);
    EXPECT_EQ(resolved(drop_case, {"physics=[\"flow\"]"}).at("physics"), nlohmann::json::array({"flow"}));
}

TEST(CaseFile, OverrideTakesTheAssumedMarkAway)
{
    EXPECT_EQ(resolved(drop_case).at("assumed").size(), 1U);
    EXPECT_EQ(resolved(drop_case, {"material.oil.viscosity=0.1 Pa s"}).at("assumed").size(), 0U);
}

TEST(CaseFile, WrongOverrideNamesItsNumber)
{
    EXPECT_THAT(refusal(drop_case, {"time.end=1 ms", "time.ende=1 ms"}),
                AllOf(StartsWith("--set:2:1: time.ende: unknown key"), HasSubstr("did you mean 'end'?")));
    EXPECT_THAT(refusal(drop_case, {"time"}), HasSubstr("is no KEY=VALUE"));
    EXPECT_THAT(refusal(drop_case, {"body.7.radius=1 mm"}), HasSubstr("no place in a list of 1"));
}

TEST(Physics, NeedsWhatItRestsOn)
{
    const auto with = [](const std::string& names) {
        return refusal(replaced(drop_case, "[\"flow\", \"surface_tension\"]", names));
    };
    EXPECT_THAT(with("[\"flow\", \"wetting\"]"), HasSubstr("'wetting' needs 'surface_tension'"));
    EXPECT_THAT(with("[\"flow\", \"laser\"]"), HasSubstr("'laser' needs 'heat'"));
    EXPECT_THAT(with("[\"heat\", \"recoil\"]"), HasSubstr("'recoil' needs 'flow'"));
    EXPECT_THAT(with("[\"flow\", \"recoil\"]"), HasSubstr("surrounding: is missing, physics 'recoil' needs"));
    EXPECT_THAT(with("[\"flow\", \"melting\"]"), HasSubstr("'melting' needs 'heat'"));
    EXPECT_THAT(with("[\"surface_tension\"]"), HasSubstr("'surface_tension' needs 'flow'"));
    EXPECT_THAT(with("[\"flow\", \"gravity\"]"), HasSubstr("gravity: is missing"));
    EXPECT_THAT(with("[\"flow\", \"surface_tention\"]"), HasSubstr("did you mean 'surface_tension'?"));
    EXPECT_THAT(with("[\"flow\", \"flow\"]"), HasSubstr("stands there twice"));
    EXPECT_THAT(with("[]"), HasSubstr("names no physics"));
}

TEST(Physics, MissingMaterialDatumIsNamed)
{
    EXPECT_EQ(
        refusal(drop_case, {"physics=[\"flow\",\"surface_tension\",\"wetting\"]"}),
        "case.toml:5:1: material.oil.contact_angle: is missing, physics 'wetting' needs it; add it to [material.oil]");
    EXPECT_THAT(refusal(drop_case, {"physics=[\"flow\",\"heat\"]"}),
                HasSubstr("material.oil.specific_heat: is missing"));
}

TEST(Physics, MarangoniWithoutHeatNeedsAGradient)
{
    const std::vector<std::string> overrides{"physics=[\"flow\",\"marangoni\"]",
                                             "material.oil.surface_tension_slope=-1 mN/(m K)"};
    EXPECT_THAT(refusal(drop_case, overrides), HasSubstr("initial.temperature_gradient: is zero"));
    auto with_gradient = overrides;
    with_gradient.emplace_back("initial.temperature_gradient=[\"1 K/m\", \"0 K/m\", \"0 K/m\"]");
    EXPECT_EQ(refusal(drop_case, with_gradient), "");
}

TEST(Geometry, ThatCannotBeFilledIsRefused)
{
    EXPECT_THAT(refusal(drop_case, {"domain.upper=[\"-2 mm\",\"0 mm\",\"1 mm\"]"}), HasSubstr("has no extent in x"));
    EXPECT_THAT(refusal(drop_case, {"domain.upper=[\"1 mm\",\"1 mm\",\"1 mm\"]"}), HasSubstr("has an extent in y"));
    EXPECT_THAT(refusal(drop_case, {"body.0.center=[\"9 mm\",\"0 mm\",\"0 mm\"]"}),
                HasSubstr("lies outside the domain"));
    EXPECT_THAT(refusal(drop_case, {"body.0.center=[\"0 mm\",\"0 mm\"]"}), HasSubstr("has 2 components"));
    EXPECT_THAT(refusal(drop_case, {"resolution.coarse=1 mm"}), HasSubstr("fewer than 4 spacings"));
    EXPECT_THAT(refusal(drop_case, {"resolution.coarse=1 nm"}), HasSubstr("more than 2e9 elements"));
    EXPECT_THAT(refusal(drop_case, {"domain.boundaries.x_min.kind=periodic"}), HasSubstr("is not periodic, but"));
    EXPECT_THAT(refusal(drop_case, {"domain.boundaries.y_min.kind=wall"}), HasSubstr("has no meaning in 2 dimensions"));
    EXPECT_THAT(refusal(drop_case, {"dimensions=3"}), HasSubstr("has no extent in y"));
}

TEST(NearestName, IsTheOneAFewLettersAway)
{
    EXPECT_EQ(nearest_name("visocsity", {"density", "viscosity"}), "viscosity");
    EXPECT_EQ(nearest_name("xyz", {"density", "viscosity"}), "");
    EXPECT_EQ(edit_distance("powr", "power"), 1U);
    EXPECT_EQ(edit_distance("pwoer", "power"), 1U);
    EXPECT_EQ(edit_distance("", "abc"), 3U);
}

} // namespace
} // namespace cupel
