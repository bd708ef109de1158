// Outlines and corners drawn at random: a few of each kind. All of them: spia-robustness --grids
// 40.
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
        const shapes::RandomOutline drawn = shapes::random_outline(GetParam(), number);
        const shapes::RandomGrid made = shapes::random_grid(drawn);
        EXPECT_EQ(made.fault, "") << drawn.name;
        EXPECT_FALSE(made.refused) << drawn.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Random, OutlineKind, testing::Range(0, shapes::outline_kinds), [](const auto& param) {
    std::string name(shapes::outline_kind(param.param));
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
});

} // namespace spia
