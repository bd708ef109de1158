#include "app/viewer/model/jobs/kept_work.h"

#include <chrono>
#include <gtest/gtest.h>
#include <thread>

#include "engine/core/error.h"
#include "tests/support/mesh_file.h"
#include "tests/support/shapes.h"
#include "tests/unit/viewer/own_home.h"
#include "tests/unit/viewer/viewer_samples.h"

namespace spia::viewer {
namespace {

namespace fs = std::filesystem;

/// The dome with three picked faces, not saved.
struct UnsavedWork : OwnHome {
    ViewerModel model{SPIA_SOURCE_DIR "/assets"};
    const ViewerState& state = model.state();
    KeptWork kept;

    void SetUp() override
    {
        open(OpenPart{dome, ""});
        pick();
    }
    void pick() { model.apply(SelectFaces{{1, 2, 3}}); }
    void wait()
    {
        while (model.busy()) {
            model.poll();
            std::this_thread::yield();
        }
        kept.follow(model, false);
    }
    void open(const Action& action)
    {
        kept.open(model, action);
        kept.follow(model, false);
        wait();
    }
    /// No part, but what may be refused or is no mesh at all.
    fs::path bad(const std::string& name)
    {
        if (name == "two.obj")
            shapes::write_mesh(folder / name, shapes::two_rectangles());
        else
            put(folder / name, "nothing\n");
        return folder / name;
    }
    bool nothing_kept() const { return !fs::exists(state_folder()) || fs::is_empty(state_folder()); }
};

TEST_F(UnsavedWork, StaysOpenWhenThePartThatWasToTakeItsPlaceIsNone)
{
    for (const char* name : {"bad.stl", "two.obj"}) {
        open(OpenPart{bad(name), ""});
        ASSERT_NE(state.document.session.part, nullptr) << name;
        EXPECT_EQ(kept.offer(), nullptr) << "nothing is lost";
        EXPECT_EQ(state.document.selected, (std::vector<int>{1, 2, 3})) << name;
        EXPECT_TRUE(state.document.unsaved);
    }
    kept.keep(state);
    EXPECT_FALSE(nothing_kept());
    kept.forget();
    EXPECT_TRUE(nothing_kept()) << "it is kept in one place";
}

TEST_F(UnsavedWork, StaysOpenWhenTheFileIsNotThere)
{
    open(OpenPart{folder / "missing.stl", ""});
    open(OpenProject{folder / "missing.spia"});
    EXPECT_EQ(kept.offer(), nullptr);
    EXPECT_EQ(state.document.selected, (std::vector<int>{1, 2, 3}));
    EXPECT_TRUE(state.document.unsaved);
}

TEST_F(UnsavedWork, IsForgottenWhenTheOtherPartIsThere)
{
    kept.keep(state);
    EXPECT_FALSE(nothing_kept());
    open(OpenPart{dome, ""});
    EXPECT_EQ(kept.offer(), nullptr);
    EXPECT_TRUE(nothing_kept());
}

TEST_F(UnsavedWork, ThatWasRecoveredOnceSurvivesAPartThatCannotBeOpenedAndACrash)
{
    {
        KeptWork crashing;
        crashing.keep(state);
    }
    ViewerModel again(SPIA_SOURCE_DIR "/assets");
    const auto run = [](ViewerModel& each, KeptWork& work, const Action& action) {
        work.open(each, action);
        while (each.busy())
            each.poll();
        work.follow(each, false);
    };
    {
        KeptWork crashing;
        ASSERT_TRUE(crashing.look_for_left());
        run(again, crashing, crashing.recover());
        run(again, crashing, OpenPart{bad("second.stl"), ""});
        EXPECT_EQ(again.state().document.selected, (std::vector<int>{1, 2, 3}));
    }
    KeptWork at_the_next_start;
    ASSERT_TRUE(at_the_next_start.look_for_left());
    ViewerModel next(SPIA_SOURCE_DIR "/assets");
    run(next, at_the_next_start, at_the_next_start.recover());
    EXPECT_EQ(next.state().document.selected, (std::vector<int>{1, 2, 3}));
    at_the_next_start.forget(); // saved
    while (at_the_next_start.look_for_left())
        at_the_next_start.discard();
    EXPECT_TRUE(nothing_kept());
}

TEST_F(UnsavedWork, IsThereAfterACrashOnReadingTheOtherPart)
{
    {
        KeptWork crashing;
        crashing.open(model, OpenPart{dome, ""});
        for (int k = 0; k < 2000 && nothing_kept(); ++k) // it is written in the background
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_TRUE(KeptWork().look_for_left());
}

TEST_F(UnsavedWork, ThatIsRecoveredIsNotForgottenWhereItsPartCannotBeRead)
{
    shapes::write_mesh(folder / "sheet.obj", shapes::rectangle(50, 40, 5, 4));
    {
        ViewerModel before(SPIA_SOURCE_DIR "/assets");
        before.apply(OpenPart{folder / "sheet.obj", ""});
        while (before.busy())
            before.poll();
        KeptWork crashing;
        crashing.keep(before.state());
    }
    put(folder / "sheet.obj", "nothing\n");
    KeptWork after;
    ASSERT_TRUE(after.look_for_left());
    after.open(model, after.recover());
    while (model.busy())
        model.poll();
    after.follow(model, false);
    EXPECT_EQ(state.document.selected, (std::vector<int>{1, 2, 3})) << "the part that is open stays";
    EXPECT_TRUE(KeptWork().look_for_left()) << "it may be readable another day";
}

TEST_F(UnsavedWork, IsGoneWhenItIsSavedDiscardedOrEndedOnPurpose)
{
    kept.keep(state);
    kept.forget();
    EXPECT_TRUE(nothing_kept());
    kept.keep(state);
    kept.end();
    EXPECT_TRUE(nothing_kept());
    {
        KeptWork crashing;
        crashing.keep(state);
    }
    ASSERT_TRUE(kept.look_for_left());
    kept.discard();
    EXPECT_EQ(kept.offer(), nullptr);
    EXPECT_TRUE(nothing_kept());
}

TEST_F(UnsavedWork, IsKeptOnceTheHandRestsAndThenEvery30Seconds)
{
    using namespace std::chrono_literals;
    const auto start = KeptWork::Clock::now();
    const auto kept_at = [&](KeptWork::Clock::duration after) {
        kept.follow(model, true, start + after);
        for (int k = 0; k < 400 && nothing_kept(); ++k) // it is written in the background
            std::this_thread::sleep_for(5ms);
        kept.follow(model, false, start + after); // takes what was written
        const bool there = !nothing_kept();
        kept.forget();
        return there;
    };
    const auto not_kept_at = [&](KeptWork::Clock::duration after) {
        kept.follow(model, true, start + after);
        std::this_thread::sleep_for(20ms);
        return nothing_kept();
    };
    EXPECT_TRUE(not_kept_at(1s));
    model.apply(SelectFaces{{4}});
    EXPECT_TRUE(not_kept_at(2s)) << "the hand may go on";
    EXPECT_NEAR(kept.due_in(start + 2s), 3, 1e-9);
    model.apply(SelectFaces{{4, 5}});
    EXPECT_TRUE(not_kept_at(4s));
    EXPECT_TRUE(not_kept_at(6s)) << "since the second change";
    EXPECT_TRUE(kept_at(7s));
    EXPECT_TRUE(not_kept_at(20s)) << "nothing is new";
    EXPECT_NEAR(kept.due_in(start + 20s), 17, 1e-9);
    EXPECT_TRUE(kept_at(37s)) << "the views may be other ones";
    for (int k = 0; k < 14; ++k) { // a hand that never rests
        model.apply(SelectFaces{{k}});
        EXPECT_TRUE(not_kept_at(38s + k * 2s)) << k;
    }
    model.apply(SelectFaces{{1}});
    EXPECT_TRUE(kept_at(67s));
}

TEST_F(UnsavedWork, ThatCannotBeWrittenIsSaidAndThePartOpensAllTheSame)
{
    put(folder / ".local", "a file where the folder should be");
    EXPECT_THROW(kept.keep(state), ExchangeError);
    open(OpenPart{bad("bad.stl"), ""});
    EXPECT_EQ(kept.offer(), nullptr);
    const auto said = [&](const Message& m) { return m.text.find("Autosave failed") != std::string::npos; };
    for (int tries = 0; tries < 5000 && std::none_of(state.messages.begin(), state.messages.end(), said); ++tries) {
        // it is written on a thread of its own
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        kept.follow(model, false);
    }
    EXPECT_TRUE(std::any_of(state.messages.begin(), state.messages.end(), said));
    open(OpenPart{dome, ""});
    EXPECT_NE(state.document.session.part, nullptr);
}

} // namespace
} // namespace spia::viewer
