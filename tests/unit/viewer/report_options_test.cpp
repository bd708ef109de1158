#include "app/viewer/model/reports/report_options.h"

#include <gtest/gtest.h>

#include "engine/options/part_options.h"
#include "tests/unit/viewer/viewer_samples.h"

namespace spia::viewer {

TEST(ReportOptions, TheStandardLookIsTheSameWhateverTheUserLooksAt)
{
    ViewerState state;
    state.document = document_of(dome, Stage::solve);
    const ViewerState before = standard_look(state);
    state.document.display = {Field::strain_minor, true, std::array{-1.0, 1.0}, ColourMap::grey, 5, true, false, true};
    state.document.selected = {1, 2, 3};
    state.view.dark = true;
    state.view.edges = true;
    state.view.camera[0].perspective = true;
    state.view.camera[0].turn = glm::dquat(0, 1, 0, 0);
    state.hovered = 7;
    const ViewerState look = standard_look(state);
    EXPECT_EQ(look.view.camera, before.view.camera);
    EXPECT_EQ(look.document.display.field, Field::thinning);
    EXPECT_TRUE(look.document.selected.empty());
    EXPECT_FALSE(look.view.dark || look.view.edges || look.hovered);
    EXPECT_TRUE(look.view.camera[size_t(View::blank)].flat);
    EXPECT_EQ(look.document.session.blank, state.document.session.blank);
}

TEST(ReportOptions, TheEngineIsToldTheWordsOfTheWindow)
{
    ViewerReportOptions chosen;
    chosen.title = "Door";
    chosen.tables.solver = false;
    chosen.lengths = LengthUnit::inch;
    const ReportOptions options = report_options(chosen);
    EXPECT_EQ(options.title, "Door");
    EXPECT_EQ(options.tables, chosen.tables);
    const std::string text = "a gap of 25.4 mm; join it with " + mention(option::weld);
    EXPECT_EQ(options.reader.told(text), "a gap of 1 in; join it with \"Weld vertices\" in the step Part");
    EXPECT_EQ(ReportReader{}.told(text), "a gap of 25.4 mm; join it with --weld");
}

} // namespace spia::viewer
