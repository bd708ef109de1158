#include <chrono>
#include <gtest/gtest.h>
#include <thread>

#include "app/viewer/model/jobs/viewer_model.h"
#include "app/viewer/model/reports/fit_cost.h"
#include "tests/support/inner_panel.h"
#include "tests/support/mesh_file.h"

namespace spia::viewer {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

template <class Done> bool wait_until(ViewerModel& model, double most_seconds, const Done& done)
{
    for (const auto start = Clock::now(); seconds_since(start) < most_seconds;) {
        model.poll();
        if (done(model.state()))
            return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
}

TEST(Cancel, TakesEffectWithinASecondOn100000TrianglesAndKeepsWhatWasFinished)
{
    shapes::InnerPanel shape;
    shape.triangles = 100000;
    const auto file = std::filesystem::path(testing::TempDir()) / "cancel-panel.obj";
    shapes::write_mesh(file, shapes::inner_panel(shape).mesh);
    ViewerModel model(SPIA_SOURCE_DIR "/assets");
    const auto idle = [](const ViewerState& state) { return !state.job.running; };
    const auto cancel = [&] {
        const auto start = Clock::now();
        model.apply(CancelJob{});
        EXPECT_TRUE(wait_until(model, 30, idle));
        return seconds_since(start);
    };

    model.apply(OpenPart{file, ""});
    EXPECT_LT(cancel(), 1.0) << "while it is read";
    model.apply(OpenPart{file, ""});
    ASSERT_TRUE(wait_until(model, 60, idle));
    ASSERT_TRUE(model.state().document.session.part);

    for (const char* step : {"first guess", "energy step", "equilibrium step"}) {
        model.apply(RunTo{Stage::fit});
        ASSERT_TRUE(wait_until(model, 60, [&](const ViewerState& state) { return state.job.step.find(step) == 0; }))
            << step;
        EXPECT_LT(cancel(), 1.0) << step;
        EXPECT_FALSE(model.state().document.session.blank);
    }
    FitChoice fit;
    fit.tolerance = 0.1;
    model.apply(SetFit{fit});
    model.apply(SetPatches{}); // one patch: its grid is a result that is wanted
    model.apply(RunTo{Stage::fit});
    ASSERT_TRUE(wait_until(model, 120, [](const ViewerState& state) { return state.job.step.find("measuring") == 0; }));
    EXPECT_LT(cancel(), 1.0) << "the fit";
    EXPECT_TRUE(model.state().document.session.blank) << "the solved blank is kept";
    EXPECT_TRUE(model.state().document.session.lifted);
    EXPECT_FALSE(model.state().document.session.surface);
    EXPECT_NE(model.state().messages.back().text.find("cancelled"), std::string::npos);
}

TEST(FitCost, GrowsWithThePartAndIsRounded)
{
    EXPECT_NE(fit_cost(5000).find("30 s"), std::string::npos);
    EXPECT_NE(fit_cost(100000).find("1 min"), std::string::npos);
    EXPECT_NE(fit_cost(500000).find("2 min"), std::string::npos);
    EXPECT_EQ(fit_cost(0), fit_cost(1));
}

} // namespace
} // namespace spia::viewer
