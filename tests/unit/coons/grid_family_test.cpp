// Outlines and corners drawn by lot: a few of each kind. All of them: spia-robustness --grids 40.
#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "tests/support/check_grid.h"

namespace spia {

class OutlineKind : public testing::TestWithParam<int> {};

TEST_P(OutlineKind, HasAGridWithoutAFold)
{
    std::vector<int> numbers = {0, 1, 2, 3, 4, 5, 6, 7};
    if (shapes::outline_kind(GetParam()) == "spiral")
        numbers = {0, 1, 12}; // they take seconds each; 12 has a grid by spiral_grid() alone
    for (const int number : numbers) {
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
