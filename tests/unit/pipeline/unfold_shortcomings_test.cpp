#include "engine/pipeline/shortcomings/unfold_shortcomings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/json_file.h"
#include "engine/forming/material/material_library.h"
#include "engine/pipeline/files/unfold_file.h"
#include "engine/report/json/unfold_report_json.h"
#include "tests/support/bent_parts.h"

namespace spia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class UnfoldShortcomings : public testing::Test {
protected:
    UnfoldShortcomings()
    {
        part.mesh = shapes::lipped_box();
        map = find_bends(part.mesh);
        steps = propose_sequence(part.mesh, map).steps;
        FlattenOptions options;
        options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
        run = run_unfolding(part.mesh, steps, options);
        run.states.back().necking = 0; // drawn corners: another shortcoming
    }

    PartFile part;
    BendMap map;
    UnfoldScript steps;
    UnfoldRun run;
};

} // namespace

TEST_F(UnfoldShortcomings, AStateBetweenThatLiesOnItselfIsOne)
{
    ASSERT_GE(run.states.size(), 3U);
    EXPECT_THAT(shortcomings(run, 100, {}), IsEmpty());
    run.states[1].overlap = {5, {1, 2, 3}, 4};
    run.states[2].overlap = {5, {1, 2, 3}, 0}; // still there, but told already
    EXPECT_THAT(
        shortcomings(run, 100, {}),
        ElementsAre(HasSubstr("step \"" + run.states[1].name +
                              "\" makes the sheet overlap itself at 4 places, so that it may be impossible; the "
                              "first is near 1, 2, 3 mm")));
    const Json report = parse_json(unfold_report_json("part.obj", part, map, steps, run, {}, {}), "report");
    ASSERT_EQ(report["shortcomings"].size(), 1U);
    EXPECT_THAT(report["shortcomings"][0].get<std::string>(), HasSubstr("makes the sheet overlap itself at 4 places"));
    EXPECT_EQ(report["states"][1]["overlap"]["landed"], 4);
    EXPECT_EQ(report["states"][2]["overlap"]["landed"], 0);
}

TEST_F(UnfoldShortcomings, TheLastStateCountsWhateverLaidItSo)
{
    run.states.back().overlap = {2, {1, 2, 3}, 0};
    EXPECT_THAT(shortcomings(run, 100, {"found before"}),
                ElementsAre("found before", "the blank overlaps itself at 2 places"));
    run.states.back().overlap.places = 1;
    EXPECT_THAT(shortcomings(run, 100, {}), ElementsAre("the blank overlaps itself at 1 place"));
}

} // namespace spia
