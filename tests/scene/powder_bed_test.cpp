#include "temporary_case.hpp"

#include "scene/powder_bed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cupel
{
namespace
{

using ::testing::HasSubstr;
using testing::TemporaryFolder;

std::string problem_with(const std::string& content)
{
    const TemporaryFolder folder;
    try {
        read_powder_bed(folder.write("bed.csv", content));
    }
    catch (const CaseError& error) {
        return error.what();
    }
    return "";
}

TEST(PowderBed, GivesTheSpheresOfItsLines)
{
    const TemporaryFolder folder;
    const auto grains =
        read_powder_bed(folder.write("bed.csv", "# head\nx_m,y_m,z_m,radius_m\n1e-6,-2e-6,3e-6,4e-6\n0,0,0,1\n"));
    ASSERT_EQ(grains.size(), 2U);
    EXPECT_EQ(grains[0].center, (Vector3{1e-6, -2e-6, 3e-6}));
    EXPECT_EQ(grains[0].radius, 4e-6);
}

TEST(PowderBed, BrokenLineIsNamed)
{
    const std::string head = "x_m,y_m,z_m,radius_m\n";
    EXPECT_THAT(problem_with(head + "1,2,3,4\n1,2,x,4\n"),
                HasSubstr("bed.csv:3:5: powder bed: here should stand a number"));
    EXPECT_THAT(problem_with(head + "1,2,3\n"), HasSubstr("bed.csv:2:"));
    EXPECT_THAT(problem_with(head + "1,2,3,4,5\n"), HasSubstr("bed.csv:2:"));
    EXPECT_THAT(problem_with(head + "1,2,nan,4\n"), HasSubstr("bed.csv:2:"));
    EXPECT_THAT(problem_with(head + "1,2,3,-4\n"), HasSubstr("the radius is not above zero"));
    EXPECT_THAT(problem_with("x,y,z,r\n"), HasSubstr("the columns are not"));
    EXPECT_THAT(problem_with(""), HasSubstr("is missing"));
}

TEST(PowderBed, MissingFileSaysHowToMakeIt)
{
    const std::string track = std::string(CUPEL_CASES_FOLDER) + "/slm_track_150w/case.toml";
    const std::vector<std::string> elsewhere{"body.1.file=/nowhere/bed.csv"};
    try {
        resolve_case(track, {"coarse", elsewhere, true});
        FAIL() << "the case was taken";
    }
    catch (const CaseError& error) {
        EXPECT_THAT(error.what(), HasSubstr("--set:1:1: body.1.file: there is no bed /nowhere/bed.csv; make it with: "
                                            "./cupel bed slm_track_150w"));
    }
    EXPECT_NO_THROW(resolve_case(track, {"coarse", elsewhere, false}));
}

TEST(PowderBed, OfTheTracksLiesInItsLayerWithoutOverlaps)
{
    const auto grains = read_powder_bed(std::string(CUPEL_CASES_FOLDER) + "/common/bed_seed1.csv");
    ASSERT_GT(grains.size(), 1000U);
    double deepest_overlap = 0;
    for (std::size_t one = 0; one < grains.size(); ++one) {
        const Grain& grain = grains[one];
        EXPECT_GE(grain.radius, 7.5e-6);
        EXPECT_LE(grain.radius, 22.5e-6);
        EXPECT_LE(grain.center[2] + grain.radius, 50e-6 * (1 + 1e-6)); // what the blade leaves
        EXPECT_GE(grain.center[2] - grain.radius, -1e-8);              // a thousandth of a grain pressed into the plate
        for (std::size_t other = 0; other < one; ++other) {
            double squared = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double difference = grain.center[axis] - grains[other].center[axis];
                squared += difference * difference;
            }
            deepest_overlap = std::max(deepest_overlap, grain.radius + grains[other].radius - std::sqrt(squared));
        }
    }
    EXPECT_LE(deepest_overlap, 3e-8); // a thousandth of the median diameter
}

} // namespace
} // namespace cupel
