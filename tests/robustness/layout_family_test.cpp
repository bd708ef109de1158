// Plates with holes drawn by lot, as patches: a few of them. All of them: spia-robustness --layouts 100.
#include <gtest/gtest.h>

#include "tests/robustness/layout_run.h"

namespace spia {

class PlateByLot : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(WithHoles, PlateByLot, testing::Values(0, 1, 2, 3, 7, 70, 77, 86, 88, 91));

TEST_P(PlateByLot, IsPatchesWithoutAFoldThatShareTheirSides)
{
    const LayoutRun run = run_layout(shapes::outline_by_lot(shapes::outline_kinds - 1, GetParam()));
    EXPECT_EQ(run.fault, "");
    EXPECT_GE(run.patches, 4);
}

} // namespace spia
