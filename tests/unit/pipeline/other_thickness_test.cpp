// A thickness that is not the solid's is a shortcoming.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/pipeline/run_stage.h"
#include "engine/pipeline/shortcomings/shortcomings.h"
#include "tests/support/cad/bent_solid.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/pipeline/solved_bent_solid.h"

namespace spia {

TEST(OtherThickness, ThanTheSolidsIsTold)
{
    const ScratchFolder folder;
    shapes::BentSolid solid;
    solid.thickness = 2;
    solid.leg = {40, 30};
    solid.bend = {{3, 1.2}};
    solid.width = 30;
    shapes::write_bent_solid(folder / "part.step", solid);
    Session session = solved_part(folder / "part.step");
    EXPECT_THAT(shortcomings(session), testing::Not(testing::Contains(testing::HasSubstr("mm thick"))));
    session.options.flatten.thickness = 3;
    session = run_stage(Stage::solve, std::move(session));
    EXPECT_THAT(shortcomings(session),
                testing::Contains(testing::HasSubstr("the solid is 2 mm thick and the sheet is calculated as 3 mm")));
}

TEST(OtherThickness, OfThickPlateIsNoQuestionWhereTheFileStatesItsUnit)
{
    const ScratchFolder folder;
    shapes::BentSolid solid;
    solid.thickness = 38;
    solid.leg = {400, 300};
    solid.bend = {{60, 1.2}};
    solid.width = 500;
    shapes::write_bent_solid(folder / "part.step", solid);
    Session session = solved_part(folder / "part.step");
    const auto question = testing::Contains(testing::HasSubstr("is that in mm?"));
    EXPECT_THAT(shortcomings(session), testing::Not(question));
    session.options.flatten.thickness = 39; // as a user may have typed it
    EXPECT_THAT(shortcomings(session), question);
}

} // namespace spia
