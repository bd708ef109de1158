#include "app/viewer/model/document/message.h"

#include <fstream>
#include <gmock/gmock.h>

#include "app/viewer/model/document/chain.h"
#include "engine/forming/material/material_library.h"
#include "tests/unit/exchange/sample_decks.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/model_fixture.h"

using testing::HasSubstr;

namespace spia::viewer {
namespace {

struct Messages : ModelFixture {
    ScratchFolder folder;

    bool shows(const std::string& text) const
    {
        return std::any_of(state.messages.begin(), state.messages.end(),
                           [&](const Message& m) { return m.shown() && m.text.find(text) != std::string::npos; });
    }
    int shown() const
    {
        return int(
            std::count_if(state.messages.begin(), state.messages.end(), [](const Message& m) { return m.shown(); }));
    }
    void run(Stage stage)
    {
        model.apply(RunTo{stage});
        wait();
    }
};

TEST_F(Messages, ARefusalGoesWithTheNextChangeAndDoesNotComeBack)
{
    open();
    model.apply(RemoveRegion{7});
    EXPECT_TRUE(shows("There is no region 8"));
    model.apply(FitView{View::part}); // no change of the document
    EXPECT_TRUE(shows("There is no region 8"));
    model.apply(SelectFaces{{1, 2}, PickMode::replace});
    EXPECT_FALSE(shows("There is no region 8"));
    model.apply(Undo{});
    EXPECT_FALSE(shows("There is no region 8"));
}

TEST_F(Messages, UpToDateIsNotSaidOfWhatWasChangedSince)
{
    open();
    run(Stage::solve);
    model.apply(RunTo{Stage::solve});
    EXPECT_TRUE(shows("Everything is up to date"));
    model.apply(SetThickness{0.8});
    EXPECT_FALSE(shows("Everything is up to date"));
}

TEST_F(Messages, WarningsOfARunGoWithItsResultsAndComeBackWithThem)
{
    open();
    model.apply(SetThickness{30});
    run(Stage::solve);
    const char* plate = "30 mm thick: is that in mm?";
    EXPECT_TRUE(shows(plate));
    model.apply(SelectFaces{{1, 2}, PickMode::replace}); // another matter
    EXPECT_TRUE(shows(plate));
    model.apply(Undo{});
    model.apply(Undo{}); // the run
    EXPECT_FALSE(document.session.blank);
    EXPECT_FALSE(shows(plate));
    model.apply(Redo{});
    EXPECT_TRUE(document.session.blank);
    EXPECT_TRUE(shows(plate));
    model.apply(SetThickness{1});
    run(Stage::solve);
    EXPECT_FALSE(shows(plate));
}

TEST_F(Messages, OfAnotherPartAreGone)
{
    open();
    model.apply(SetThickness{30});
    run(Stage::solve);
    open("fender.obj");
    EXPECT_FALSE(shows("30 mm thick"));
}

TEST_F(Messages, OnOpeningSayHowManyNotesTheStepPartHas)
{
    std::ofstream(folder / "strip.k") << sample::dyna();
    model.apply(OpenPart{folder / "strip.k", "", {.parts = {"7"}}});
    wait();
    ASSERT_TRUE(document.session.part);
    const PartFile& part = *document.session.part;
    const std::vector<std::string> notes = notes_on_reading(part);
    ASSERT_FALSE(notes.empty());
    EXPECT_EQ(shown(), 1);
    const size_t count = notes.size() + part.doctor.findings.size();
    EXPECT_EQ(state.messages.back().text, fmt::format("Opened strip.k: {}, see the step Part.",
                                                      count == 1 ? "1 note" : fmt::format("{} notes", count)));
    EXPECT_THAT(notes, testing::Contains(HasSubstr("a thickness of 1.25 mm")));
    for (const std::string& doubt : part.doubts) // which make the light amber
        EXPECT_THAT(notes, testing::Not(testing::Contains(doubt)));
    EXPECT_EQ(document.session.options.flatten.thickness, 1.25);
    EXPECT_EQ(document.thickness_from, SheetSource::file);
}

TEST_F(Messages, APartThatIsReadAndUnfoldedInOneRunHasTheThicknessOfItsFileUnlessOneIsWished)
{
    std::ofstream(folder / "strip.k") << sample::dyna();
    Session session;
    session.file = folder / "strip.k";
    session.options.read.parts = {"7"};
    session.options.flatten.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    for (const std::optional<double> wished : {std::optional<double>(), std::optional(0.9)}) {
        const ChainResult result =
            run_and_note(session, {}, Stage::read, Stage::solve, Progress(), {.thickness = wished});
        ASSERT_FALSE(result.failed) << result.message;
        EXPECT_EQ(result.session.options.flatten.thickness, wished.value_or(1.25));
        EXPECT_EQ(result.made_with.flatten.thickness, wished.value_or(1.25));
    }
}

TEST_F(Messages, OfAChangeGoWhenItIsUndone)
{
    History history;
    Document now;
    const int before = history.now();
    history.remember("a", now);
    const int after_a = history.now();
    history.remember("b", now, true);
    const int begun = history.now();
    history.remember("b", now, true); // the same drag
    EXPECT_TRUE(history.has(before) && history.has(after_a) && history.has(history.now()));
    EXPECT_FALSE(history.has(begun)) << "on the way of a drag";
    history.undo(now);
    EXPECT_EQ(history.now(), after_a);
    history.undo(now);
    EXPECT_EQ(history.now(), before);
    EXPECT_FALSE(history.has(after_a));
    history.redo(now);
    EXPECT_EQ(history.now(), after_a);
    EXPECT_TRUE(history.has(before));
    history.forget_last();
    EXPECT_EQ(history.now(), before);
}

TEST_F(Messages, AnErrorThatSpeaksOfNothingElseGoesWithTheNextChange)
{
    open();
    model.apply(OpenPart{folder / "nowhere.obj", ""});
    wait();
    EXPECT_TRUE(shows("nowhere.obj"));
    model.apply(SelectFaces{{1, 2}, PickMode::replace});
    EXPECT_FALSE(shows("nowhere.obj"));
}

} // namespace
} // namespace spia::viewer
