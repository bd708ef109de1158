// Jobs that are cancelled and come to no checkpoint: nobody waits for them, and what they do
// afterwards is not seen.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <mutex>
#include <thread>

#include "app/viewer/model/jobs/viewer_model.h"
#include "tests/support/bent_parts.h"
#include "tests/support/mesh_file.h"
#include "tests/unit/exchange/scratch_folder.h"
#include "tests/unit/viewer/viewer_samples.h"

namespace spia::viewer {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// Stops other threads at their checkpoints while it is shut.
class Gate {
public:
    /// For the model: jobs call it within their checkpoints.
    void pass()
    {
        if (std::this_thread::get_id() == owner_)
            return;
        std::unique_lock lock(mutex_);
        const int ticket = next_++;
        moved_.wait(lock, [&] { return open_ || ticket < let_on_; });
    }
    void shut() { set(false); }
    void open() { set(true); }
    /// How many have come to it.
    int issued()
    {
        const std::lock_guard lock(mutex_);
        return next_;
    }
    /// Lets on the first ones that have come to it, up to the next checkpoint.
    void let_on(int first_ones)
    {
        const std::lock_guard lock(mutex_);
        let_on_ = first_ones;
        moved_.notify_all();
    }

private:
    void set(bool open)
    {
        const std::lock_guard lock(mutex_);
        open_ = open;
        moved_.notify_all();
    }

    const std::thread::id owner_ = std::this_thread::get_id();
    std::mutex mutex_;
    std::condition_variable moved_;
    bool open_ = true;
    int next_ = 0, let_on_ = 0; ///< tickets
};

struct LeftJobs : testing::Test {
    ScratchFolder folder;
    Gate gate;
    ViewerModel model{SPIA_SOURCE_DIR "/assets", [this] { gate.pass(); }};
    const ViewerState& state = model.state();
    const Document& document = state.document;

    ~LeftJobs() override { gate.open(); } // the model waits for what is ending

    bool wait(double most_seconds, const std::function<bool()>& done)
    {
        const auto start = std::chrono::steady_clock::now();
        while (!done()) {
            if (std::chrono::steady_clock::now() - start > std::chrono::duration<double>(most_seconds))
                return false;
            model.poll();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return true;
    }
    void rest()
    {
        ASSERT_TRUE(wait(60, [&] { return !model.busy(); }));
    }
    void propose_for_a_lipped_box()
    {
        shapes::write_mesh(folder / "part.obj", shapes::lipped_box());
        model.apply(OpenPart{folder / "part.obj", ""});
        rest();
        model.apply(ProposeSteps{});
        rest();
    }
    /// Lets the job on from checkpoint to checkpoint until it stands at a step.
    bool stands_at(const std::string& step)
    {
        return wait(60, [&] {
            const int seen = gate.issued(); // who comes after this may stand at the step
            model.poll();
            if (state.job.step.find(step) != std::string::npos)
                return true;
            gate.let_on(seen);
            return false;
        });
    }
    /// Nobody lets it on: it comes to no checkpoint. 1 s is what a cancel may take.
    void cancel()
    {
        model.apply(CancelJob{});
        EXPECT_TRUE(wait(1, [&] { return !model.busy(); })) << state.job.step;
        EXPECT_FALSE(state.job.running);
    }
    /// What was left goes on, and ends.
    void let_go()
    {
        gate.open();
        wait(0.3, [] { return false; }); // enough for a file to be written, if it were
    }
    const std::string& said() const { return state.messages.back().text; }
};

} // namespace

TEST_F(LeftJobs, AnExportThatIsLeftWritesNothingMore)
{
    model.apply(OpenPart{dome, ""});
    rest();
    model.apply(RunTo{Stage::solve});
    rest();
    const ExportFiles both{folder / "out", {"dxf", "vtu"}, {}};
    gate.shut();
    model.apply(both);
    ASSERT_TRUE(stands_at("writing dome.vtu")) << "the content is there, but not the file";
    EXPECT_GT(state.job.fraction, 0.5) << "of two files one is there";
    cancel();
    const fs::path dxf = folder / "out" / "dome.dxf", vtu = folder / "out" / "dome.vtu";
    EXPECT_TRUE(fs::exists(dxf));
    EXPECT_THAT(said(), HasSubstr("cancelled. 1 file was written before"));
    ASSERT_TRUE(state.exported);
    EXPECT_TRUE(state.exported->cancelled);
    EXPECT_EQ(state.exported->files, std::vector<fs::path>{dxf});
    let_go();
    EXPECT_FALSE(fs::exists(vtu));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "out"), {}), 1) << "nor is anything else left";
    model.apply(both);
    rest();
    EXPECT_TRUE(fs::exists(vtu));
    EXPECT_FALSE(state.exported->cancelled);
    EXPECT_EQ(state.exported->files.size(), 2u);
}

TEST_F(LeftJobs, WhatIsFixedStaysWhereItIsInProposedSteps)
{
    propose_for_a_lipped_box();
    const int by_itself = document.proposal->root;
    const BendMap& map = document.bends->map;
    int face = 0;
    while (map.label[face] == by_itself || map.label[face] >= int(map.regions.size()))
        ++face;
    model.apply(SelectFaces{{face}});
    model.apply(MakeRegion{"clamp", RegionKind::fixed});
    model.apply(ProposeSteps{});
    rest();
    EXPECT_EQ(document.proposal->root, map.label[face]);
}

TEST_F(LeftJobs, StepsThatEndedBeforeARunIsLeftAreKept)
{
    propose_for_a_lipped_box();
    ASSERT_EQ(document.steps.size(), 5u);
    for (const bool edited : {false, true}) { // as they were proposed, and as a list of the user's
                                              // own
        if (edited) {
            ChangeStep change;
            change.step = 4;
            change.name = "mine";
            model.apply(change);
        }
        const size_t before = steps_done(document);
        gate.shut();
        model.apply(RunSteps{});
        ASSERT_TRUE(stands_at(document.steps[before + 1]->name));
        cancel();
        EXPECT_EQ(steps_done(document), before + 1) << "the step before the one that was left";
        EXPECT_THAT(said(), HasSubstr(fmt::format("cancelled. {} of 5 steps are done", before + 1)));
        let_go();
    }
    model.apply(RunSteps{});
    rest();
    EXPECT_TRUE(all_steps_done(document));
}

TEST_F(LeftJobs, AFileOfStepsThatIsLeftIsNotWritten)
{
    propose_for_a_lipped_box();
    gate.shut();
    model.apply(SaveSteps{folder / "steps.json"});
    ASSERT_TRUE(stands_at("writing steps.json"));
    cancel();
    let_go();
    EXPECT_FALSE(fs::exists(folder / "steps.json"));
    model.apply(SaveSteps{folder / "steps.json"});
    rest();
    EXPECT_TRUE(fs::exists(folder / "steps.json"));
}

} // namespace spia::viewer
