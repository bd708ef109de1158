// A thickness that is not the solid's is a shortcoming.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {

/// One bend of 1.2 radians, as a STEP file; solved.
static Session solved_bracket(double thickness, double inner_radius, std::vector<double> legs, double width)
{
    const ScratchFolder folder;
    shapes::BentSolid solid;
    solid.thickness = thickness;
    solid.leg = std::move(legs);
    solid.bend = {{inner_radius, 1.2}};
    solid.width = width;
    shapes::write_bent_solid(folder / "part.step", solid);
    return solved_part(folder / "part.step");
}

TEST(OtherThickness, ThanTheSolidsIsTold)
{
    Session session = solved_bracket(2, 3, {40, 30}, 30);
    EXPECT_THAT(shortcomings(session), testing::Not(testing::Contains(testing::HasSubstr("mm thick"))));
    session.options.flatten.thickness = 3;
    session = run_stage(Stage::solve, std::move(session));
    EXPECT_THAT(shortcomings(session),
                testing::Contains(testing::HasSubstr("the solid is 2 mm thick and the sheet is calculated as 3 mm")));
}

TEST(OtherThickness, OfThickPlateIsNoQuestionWhereTheFileStatesItsUnit)
{
    Session session = solved_bracket(38, 60, {400, 300}, 500);
    const auto question = testing::Contains(testing::HasSubstr("is that in mm?"));
    EXPECT_THAT(shortcomings(session), testing::Not(question));
    session.options.flatten.thickness = 39; // as a user may have typed it
    EXPECT_THAT(shortcomings(session), question);
}

} // namespace spia
