// What of the user's would be lost is asked about, once the file that takes its place is read; and
// options that were changed in vain go back.
#include <fstream>
#include <gtest/gtest.h>

#include "app/viewer/model/document/chain.h"
#include "app/viewer/model/document/fit_choice.h"
#include "tests/unit/viewer/model_fixture.h"

namespace spia::viewer {
namespace {

struct AskedFirst : ModelFixture {
    std::filesystem::path other = assets / "parts" / "square-cup.obj";
    void SetUp() override { model.ask_before_replacing(true); }
};

TEST_F(AskedFirst, ResultsAloneAreNoWorkThatCouldBeLost)
{
    open();
    model.apply(RunTo{Stage::fit});
    wait();
    ASSERT_TRUE(document.session.surface);
    EXPECT_FALSE(state.document.unsaved);
    model.apply(Undo{});
    model.apply(Redo{});
    EXPECT_FALSE(state.document.unsaved);
    model.apply(OpenPart{other, ""});
    wait();
    EXPECT_EQ(document.session.file, other);

    model.apply(SetThickness{2});
    EXPECT_TRUE(state.document.unsaved) << "a choice is";
}

TEST_F(AskedFirst, WhatIsReadWaitsForTheUsersWord)
{
    open();
    model.apply(SelectFaces{{1, 2}});
    const auto part = document.session.part;
    const int documents = model.documents();
    model.apply(OpenPart{other, ""});
    wait();
    ASSERT_EQ(state.read_and_waits, other);
    EXPECT_EQ(document.session.part, part);
    model.apply(TakeOpened{false}); // saving has failed, say
    EXPECT_EQ(document.session.part, part);
    ASSERT_TRUE(state.read_and_waits);
    model.apply(DropOpened{});
    EXPECT_FALSE(state.read_and_waits);
    EXPECT_EQ(document.session.part, part);
    EXPECT_EQ(model.documents(), documents);
    EXPECT_FALSE(model.opening_beside());
    model.apply(SelectFaces{{3}}); // goes on as before
    EXPECT_EQ(document.selected, (std::vector<int>{3}));
    model.apply(RunTo{Stage::solve});
    wait();
    EXPECT_TRUE(document.session.blank);

    model.apply(OpenPart{other, ""});
    wait();
    model.apply(TakeOpened{true});
    EXPECT_EQ(document.session.file, other);
    EXPECT_EQ(model.documents(), documents + 1);
    EXPECT_FALSE(state.document.unsaved);
}

TEST_F(AskedFirst, NobodyIsAskedForAFileThatCannotBeRead)
{
    open();
    model.apply(SelectFaces{{1, 2}});
    const auto file = std::filesystem::temp_directory_path() / "spia-asked-first.obj";
    std::ofstream(file) << "v 0 0 x\n";
    model.apply(OpenPart{file, ""});
    wait();
    EXPECT_FALSE(state.read_and_waits);
    EXPECT_TRUE(says(Severity::error, "dome.obj is still open"));
    EXPECT_EQ(document.selected, (std::vector<int>{1, 2}));
    std::filesystem::remove(file);
}

TEST_F(AskedFirst, ASurfaceThatIsCancelledLeavesOptionsAndResultInAgreement)
{
    open("inner-panel.obj");
    model.apply(RunTo{Stage::fit});
    wait();
    const auto surface = document.session.surface;
    ASSERT_TRUE(surface);
    const FitChoice before = fit_choice(document.session.options);
    FitChoice within = before;
    within.tolerance = 0.001;
    model.apply(SetFit{within});
    ASSERT_TRUE(model.busy());
    model.apply(CancelJob{});
    wait();
    EXPECT_EQ(document.session.surface, surface);
    EXPECT_EQ(fit_choice(document.session.options), before);
    EXPECT_EQ(first_stale(document), std::nullopt);
    EXPECT_FALSE(state.document.unsaved);
    EXPECT_TRUE(says(Severity::hint, "options are again those of the result"));

    model.apply(Redo{}); // wanted after all: then the result is old, and is said to be
    EXPECT_EQ(fit_choice(document.session.options), within);
    EXPECT_EQ(first_stale(document), Stage::fit);
}

} // namespace
} // namespace spia::viewer
