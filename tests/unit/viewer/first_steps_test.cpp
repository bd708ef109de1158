#include "app/viewer/model/reports/first_steps.h"

#include <gtest/gtest.h>

#include "tests/unit/viewer/viewer_samples.h"

namespace spia::viewer {
namespace {

bool says(const ViewerState& state, const char* what, bool exported = false)
{
    return first_steps(state, exported).find(what) != std::string::npos;
}

} // namespace

TEST(FirstSteps, AreThoseThatHaveNotBeenDone)
{
    ViewerState state;
    EXPECT_EQ(first_steps(state, false), "");
    state.document = document_of(dome, Stage::read);
    EXPECT_TRUE(says(state, "1. Press"));
    EXPECT_TRUE(says(state, "2. Look"));
    EXPECT_TRUE(says(state, "3. Export"));
    state.document = document_of(dome, Stage::fit);
    EXPECT_FALSE(says(state, "Press"));
    EXPECT_TRUE(says(state, "1. Look"));
    EXPECT_FALSE(says(state, "Export", true));
    EXPECT_FALSE(says(state, "1.", true)); // a single step needs no number
    state.document.session.options.corners = {0, 1, 2, 3};
    EXPECT_FALSE(says(state, "Look"));
    EXPECT_EQ(first_steps(state, true), "");
}

TEST(FirstSteps, AreNotShownWhileSomethingRuns)
{
    ViewerState state;
    state.document = document_of(dome, Stage::read);
    state.job.running = true;
    EXPECT_EQ(first_steps(state, false), "");
}

} // namespace spia::viewer
