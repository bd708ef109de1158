#include "engine/core/sort_in_parts.h"

#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace spia {

TEST(SortInParts, GivesTheOrderOfSortWithPausesInBetween)
{
    std::mt19937 random(3);
    for (const int count : {0, 1, 1000, 1 << 17, (1 << 17) + 1, 700'001}) {
        std::vector<int> key(static_cast<size_t>(count)), parts(key.size());
        for (int& k : key)
            k = int(random() % 1000); // most are there many times
        std::iota(parts.begin(), parts.end(), 0);
        std::vector<int> once = parts;
        const auto less = [&](int a, int b) {
            return key[size_t(a)] < key[size_t(b)] || (key[size_t(a)] == key[size_t(b)] && a > b);
        };
        int pauses = 0;
        sort_in_parts(parts, less, [&] { ++pauses; });
        std::sort(once.begin(), once.end(), less);
        EXPECT_EQ(parts, once) << count;
        EXPECT_GE(pauses, (count + (1 << 17) - 1) >> 17) << count;
    }
}

} // namespace spia
