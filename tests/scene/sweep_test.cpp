#include "temporary_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cupel
{
namespace
{

using nlohmann::json;
using testing::drop_case;
using ::testing::HasSubstr;
using testing::replaced;
using ::testing::StartsWith;
using testing::TemporaryFolder;

const std::string swept_case = drop_case + R"([sweep.thin]
material.oil.viscosity = "1e-3 Pa s"
[sweep.small]
title = "A small drop"
body.0.radius = "0.25 mm"
resolution.medium = "5 um"
)";

json variation_of(const std::string& content, const std::string& variation,
                  const std::vector<std::string>& overrides = {})
{
    const TemporaryFolder folder;
    return resolve_case(folder.write("drop/case.toml", content), {"coarse", overrides, true, variation});
}

std::string refusal_of(const std::string& content, const std::string& variation)
{
    try {
        static_cast<void>(variation_of(content, variation));
    }
    catch (const CaseError& error) {
        const std::string message = error.what();
        return message.substr(message.find("case.toml"));
    }
    return "";
}

TEST(Sweep, VariationLiesOverTheFile)
{
    const json thin = variation_of(swept_case, "thin");
    EXPECT_EQ(thin.at("name"), "drop_thin");
    EXPECT_EQ(thin.at("variation"), "thin");
    EXPECT_EQ(thin.at("materials").at("oil").at("viscosity"), 1e-3);
    EXPECT_EQ(thin.at("bodies")[0].at("radius"), 5e-4);
    const json small = variation_of(swept_case, "small");
    EXPECT_EQ(small.at("title"), "A small drop");
    EXPECT_EQ(small.at("bodies")[0].at("radius"), 2.5e-4);
    EXPECT_EQ(small.at("materials").at("oil").at("viscosity"), 0.05);
    EXPECT_EQ(case_from_resolved(small).variation, "small");
    EXPECT_TRUE(variation_of(drop_case, "").at("variation").is_null());
}

TEST(Sweep, OverrideLiesOverTheVariation)
{
    EXPECT_EQ(variation_of(swept_case, "small", {"body.0.radius=0.1 mm"}).at("bodies")[0].at("radius"), 1e-4);
}

TEST(Sweep, VariationHasAHashOfItsOwn)
{
    EXPECT_NE(variation_of(swept_case, "thin").at("hash"), variation_of(swept_case, "small").at("hash"));
}

TEST(Sweep, UnknownOrMissingVariationNamesWhatThereIs)
{
    EXPECT_EQ(refusal_of(swept_case, "smal"), "case.toml:1:1: --variation: there is no variation 'smal'; take one of: "
                                              "thin, small (did you mean 'small'?)");
    EXPECT_THAT(refusal_of(swept_case, ""), HasSubstr("is missing, the case has variations; take one of: thin, small"));
    EXPECT_THAT(refusal_of(drop_case, "thin"), HasSubstr("the case has no variations"));
}

TEST(Sweep, ErrorInAVariationNamesItsPlace)
{
    EXPECT_THAT(
        refusal_of(replaced(swept_case, "material.oil.viscosity = \"1e-3", "material.oil.viscosty = \"1e-3"), "thin"),
        StartsWith("case.toml:23:14: material.oil.viscosty: unknown key; correct it"));
    EXPECT_THAT(refusal_of(replaced(swept_case, "body.0.radius", "body.1.radius"), "small"),
                StartsWith("case.toml:26:6: 1: is no place in a list of 1; count from 0"));
    EXPECT_THAT(refusal_of(replaced(swept_case, "[sweep.thin]", "[sweep.\"very thin\"]"), "small"),
                HasSubstr("use letters, digits and _ only"));
    EXPECT_THAT(refusal_of(replaced(swept_case, "[sweep.thin]", "[sweep.thin]\ntier = \"v0\""), "small"),
                HasSubstr("sweep.thin.tier: cannot vary"));
    EXPECT_THAT(refusal_of(drop_case + "[sweep]\nthin = 1\n", "thin"), HasSubstr("sweep.thin: is a number"));
}

TEST(Sweep, SummaryListsTheMembersInTheOrderOfTheFile)
{
    const TemporaryFolder folder;
    const json summary = summarize_case(folder.write("drop/case.toml", "tier = \"v0\"\n" + swept_case));
    EXPECT_EQ(summary.at("tier"), "v0");
    ASSERT_EQ(summary.at("members").size(), 2U);
    EXPECT_EQ(summary.at("members")[0].at("name"), "drop_thin");
    EXPECT_EQ(summary.at("members")[0].at("levels"), json::array({"coarse"}));
    EXPECT_EQ(summary.at("members")[1].at("variation"), "small");
    EXPECT_EQ(summary.at("members")[1].at("levels"), json::array({"coarse", "medium"}));
    const json single = summarize_case(folder.write("one/case.toml", drop_case));
    EXPECT_EQ(single.at("members")[0].at("name"), "one");
    EXPECT_TRUE(single.at("members")[0].at("variation").is_null());
    EXPECT_TRUE(single.at("tier").is_null());
}

TEST(Sweep, ComesFromTheBaseFileAsWell)
{
    const TemporaryFolder folder;
    folder.write("drop/case.toml", swept_case);
    const std::string file = folder.write("other/case.toml", "base = \"../drop/case.toml\"\ntime.end = \"2 ms\"\n");
    const json thin = resolve_case(file, {"coarse", {}, true, "thin"});
    EXPECT_EQ(thin.at("name"), "other_thin");
    EXPECT_EQ(thin.at("time").at("end"), 2e-3);
}

} // namespace
} // namespace cupel
