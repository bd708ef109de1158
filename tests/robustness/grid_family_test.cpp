// Outlines and corners drawn by lot, 320 of them: each ends with a grid in which no cell folds, but for some spirals.
#include <algorithm>
#include <gtest/gtest.h>

#include "tests/support/check_grid.h"

namespace spia {

constexpr int outlines_per_kind = 40, outlines_per_test = 10;

class GridFamily : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(GridFamily, FoldsNoCell)
{
    const auto [kind, part] = GetParam();
    // Spirals with all corners far from the inner end need hundreds of cells across: these may be refused, by name.
    const bool may_refuse = shapes::outline_kind(kind) == "spiral";
    for (int number = part * outlines_per_test; number < (part + 1) * outlines_per_test; ++number) {
        const shapes::OutlineByLot lot = shapes::outline_by_lot(kind, number);
        const shapes::GridByLot made = shapes::grid_by_lot(lot);
        EXPECT_EQ(made.fault, "") << lot.name;
        EXPECT_TRUE(may_refuse || !made.refused) << lot.name;
    }
}

INSTANTIATE_TEST_SUITE_P(ByLot, GridFamily,
                         testing::Combine(testing::Range(0, shapes::outline_kinds),
                                          testing::Range(0, outlines_per_kind / outlines_per_test)),
                         [](const auto& param) {
                             std::string name(shapes::outline_kind(std::get<0>(param.param)));
                             std::replace(name.begin(), name.end(), ' ', '_');
                             return name + "_" + std::to_string(std::get<1>(param.param));
                         });

} // namespace spia
