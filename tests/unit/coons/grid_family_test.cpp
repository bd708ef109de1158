// Outlines and corners drawn by lot: a few of each kind. All of them: spia-robustness --grids 40.
#include <algorithm>
#include <gtest/gtest.h>

#include "tests/support/check_grid.h"

namespace spia {

class OutlineKind : public testing::TestWithParam<int> {};

TEST_P(OutlineKind, HasAGridWithoutAFold)
{
    const bool spiral = shapes::outline_kind(GetParam()) == "spiral";
    for (int number = 0; number < (spiral ? 2 : 8); ++number) { // spirals take seconds each
        const shapes::OutlineByLot lot = shapes::outline_by_lot(GetParam(), number);
        const shapes::GridByLot made = shapes::grid_by_lot(lot);
        EXPECT_EQ(made.fault, "") << lot.name;
        EXPECT_FALSE(made.refused) << lot.name;
    }
}

INSTANTIATE_TEST_SUITE_P(ByLot, OutlineKind, testing::Range(0, shapes::outline_kinds), [](const auto& param) {
    std::string name(shapes::outline_kind(param.param));
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
});

} // namespace spia
