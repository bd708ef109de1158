// Plates with holes drawn at random, as patches: a few of them. All of them: spia-robustness
// --layouts 100.
#include <gtest/gtest.h>

#include "tests/robustness/layout_run.h"

namespace spia {

class RandomPlate : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(WithHoles, RandomPlate, testing::Values(0, 1, 2, 3, 7, 70, 77, 86, 88, 91));

TEST_P(RandomPlate, IsPatchesWithoutAFoldThatShareTheirSides)
{
    const LayoutRun run = run_layout(shapes::random_outline(shapes::outline_kinds - 1, GetParam()));
    EXPECT_EQ(run.fault, "");
    EXPECT_GE(run.patches, 4);
}

} // namespace spia
