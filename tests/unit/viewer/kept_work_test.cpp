#include "app/viewer/model/kept_work.h"

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

TEST_F(UnsavedWork, IsOfferedWhenThePartThatWasToTakeItsPlaceIsNone)
{
    for (const char* name : {"bad.stl", "two.obj"}) {
        open(OpenPart{bad(name), ""});
        ASSERT_EQ(state.document.session.part, nullptr) << name;
        ASSERT_NE(kept.offer(), nullptr) << name;
        EXPECT_NE(kept.offer()->text.find(name), std::string::npos) << kept.offer()->text;
        EXPECT_NE(kept.offer()->text.find("dome.obj"), std::string::npos) << kept.offer()->text;
        open(kept.recover());
        EXPECT_EQ(kept.offer(), nullptr);
        ASSERT_NE(state.document.session.part, nullptr) << name;
        EXPECT_EQ(state.document.selected, (std::vector<int>{1, 2, 3})) << name;
        EXPECT_TRUE(state.unsaved);
    }
}

TEST_F(UnsavedWork, StaysOpenWhenTheFileIsNotThere)
{
    open(OpenPart{folder / "missing.stl", ""});
    open(OpenProject{folder / "missing.spia"});
    EXPECT_EQ(kept.offer(), nullptr);
    EXPECT_EQ(state.document.selected, (std::vector<int>{1, 2, 3}));
    EXPECT_TRUE(state.unsaved);
}

TEST_F(UnsavedWork, IsForgottenWhenTheOtherPartIsThere)
{
    kept.keep(state);
    EXPECT_FALSE(nothing_kept());
    open(OpenPart{dome, ""});
    EXPECT_EQ(kept.offer(), nullptr);
    EXPECT_TRUE(nothing_kept());
}

TEST_F(UnsavedWork, ThatWasRecoveredOnceSurvivesAPartThatCannotBeOpened)
{
    open(OpenPart{bad("first.stl"), ""});
    open(kept.recover());
    open(OpenPart{bad("second.stl"), ""});
    ASSERT_NE(kept.offer(), nullptr);
    kept.later();
    kept.end();
    KeptWork at_the_next_start;
    ASSERT_TRUE(at_the_next_start.look_for_left());
    ViewerModel next(SPIA_SOURCE_DIR "/assets");
    at_the_next_start.open(next, at_the_next_start.recover());
    while (next.busy())
        next.poll();
    EXPECT_EQ(next.state().document.selected, (std::vector<int>{1, 2, 3}));
    at_the_next_start.forget(); // saved
    EXPECT_TRUE(nothing_kept());
}

TEST_F(UnsavedWork, StaysForTheNextStartIfTheProgramEndsBeforeTheOtherPartIsThere)
{
    {
        KeptWork ending;
        ending.open(model, OpenPart{dome, ""});
        ending.end();
    }
    EXPECT_TRUE(KeptWork().look_for_left());
}

TEST_F(UnsavedWork, IsGoneWhenItIsSavedDiscardedOrEndedOnPurpose)
{
    kept.keep(state);
    kept.forget();
    EXPECT_TRUE(nothing_kept());
    kept.keep(state);
    kept.end();
    EXPECT_TRUE(nothing_kept());
    open(OpenPart{bad("bad.stl"), ""});
    ASSERT_NE(kept.offer(), nullptr);
    kept.discard();
    EXPECT_EQ(kept.offer(), nullptr);
    EXPECT_TRUE(nothing_kept());
}

TEST_F(UnsavedWork, ThatCannotBeWrittenIsSaidAndThePartOpensAllTheSame)
{
    put(folder / ".local", "a file where the folder should be");
    EXPECT_THROW(kept.keep(state), ExchangeError);
    open(OpenPart{bad("bad.stl"), ""});
    EXPECT_EQ(kept.offer(), nullptr);
    ASSERT_FALSE(state.messages.empty());
    EXPECT_NE(state.messages.back().text.find("could not be kept"), std::string::npos) << state.messages.back().text;
    open(OpenPart{dome, ""});
    EXPECT_NE(state.document.session.part, nullptr);
}

} // namespace
} // namespace spia::viewer
