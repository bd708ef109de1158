#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <memory>

#include "engine/forming/material/material_library.h"
#include "engine/unfold/automatic_unfolding.h"
#include "tests/support/bent_parts.h"

namespace spia::unfolding_cancelled_test {
namespace {

FlattenOptions steel()
{
    FlattenOptions options;
    options.material = find_material("mild_steel", SPIA_SOURCE_DIR "/assets/materials");
    return options;
}

/// Asks to stop as soon as a step is begun.
Progress stopping_at(const std::string& step)
{
    const auto stop = std::make_shared<std::atomic<bool>>(false);
    return Progress([=](double, std::string_view now) { *stop = *stop || now == step; }, stop);
}

/// Runs until a step is begun, then goes on from what the cancelled run left.
void expect_resumed(const TriMesh& part, const UnfoldScript& steps, size_t at, const UnfoldRun& whole,
                    const std::function<void(const Progress&)>& run)
{
    try {
        run(stopping_at(steps[at].name));
        FAIL() << "was not cancelled at step " << at + 1;
    } catch (const UnfoldingCancelled& cancelled) {
        ASSERT_EQ(cancelled.done.states.size(), at);
        ASSERT_EQ(cancelled.steps.size(), steps.size());
        EXPECT_FALSE(cancelled.done.blank);
        for (size_t k = 0; k < at; ++k)
            EXPECT_EQ(cancelled.done.states[k].position, whole.states[k].position) << k;
        const UnfoldRun rest = run_unfolding(part, cancelled.steps, steel(), {}, &cancelled.done, at);
        ASSERT_TRUE(rest.blank);
        EXPECT_EQ(rest.blank->position, whole.blank->position);
    }
}

} // namespace

TEST(UnfoldingCancelled, LeavesTheStepsBeforeAndTheRestGivesTheSameBits)
{
    const TriMesh part = shapes::lipped_box();
    const BendMap map = find_bends(part);
    const UnfoldScript steps = propose_sequence(part, map).steps;
    const UnfoldRun whole = run_unfolding(part, steps, steel());
    ASSERT_TRUE(whole.blank);
    for (size_t at = 0; at < steps.size(); ++at) {
        expect_resumed(part, steps, at, whole,
                       [&](const Progress& progress) { run_unfolding(part, steps, steel(), progress); });
        expect_resumed(part, steps, at, whole,
                       [&](const Progress& progress) { automatic_unfolding(part, map, {}, steel(), progress); });
    }
}

TEST(UnfoldingCancelled, CountsTheStatesThatWereKeptFromBefore)
{
    const TriMesh part = shapes::lipped_box();
    const UnfoldScript steps = propose_sequence(part, find_bends(part)).steps;
    ASSERT_GE(steps.size(), 3U);
    const UnfoldRun whole = run_unfolding(part, steps, steel());
    try {
        run_unfolding(part, steps, steel(), stopping_at(steps[2].name), &whole, 1);
        FAIL() << "was not cancelled";
    } catch (const UnfoldingCancelled& cancelled) {
        EXPECT_EQ(cancelled.done.states.size(), 2U);
    }
}

} // namespace spia::unfolding_cancelled_test
