#include "engine/mesh/edge_uses.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <tuple>

namespace spia {
namespace {

auto key(const EdgeUse& use) { return std::tuple(use.low, use.high, use.face, use.corner); }

} // namespace

TEST(EdgeUses, AreEverySideOnceInTheOrderOfVerticesAndFaces)
{
    std::mt19937 random(3); // some triangles have a vertex twice, some vertices none
    std::uniform_int_distribution<int> vertex(0, 60);
    for (int faces = 0; faces < 200; faces += 13) {
        Eigen::Matrix3Xi triangle(3, faces);
        for (int& v : triangle.reshaped())
            v = vertex(random);
        const std::vector<EdgeUse> uses = edge_uses(triangle);
        ASSERT_EQ(uses.size(), size_t(triangle.size()));
        EXPECT_TRUE(std::ranges::is_sorted(uses, [](const EdgeUse& a, const EdgeUse& b) { return key(a) < key(b); }));
        std::vector<std::pair<int, int>> sides;
        for (const EdgeUse& use : uses) {
            const int from = triangle(use.corner, use.face), to = triangle((use.corner + 1) % 3, use.face);
            EXPECT_EQ(std::minmax(from, to), std::minmax(use.low, use.high));
            EXPECT_LE(use.low, use.high);
            EXPECT_EQ(use.forward, from < to);
            sides.emplace_back(use.face, use.corner);
        }
        std::ranges::sort(sides);
        EXPECT_EQ(std::ranges::unique(sides).begin(), sides.end());
    }
}

} // namespace spia
