#include "engine/mesh/segment_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace spia {

TEST(SegmentDistance, IsTheLeastOfAllToTheLastBit)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(-100, 100);
    for (const int count : {1, 3, 40, 700}) {
        Eigen::Matrix2Xd position(2, count + 1);
        for (double& x : position.reshaped())
            x = anywhere(random);
        position.col(count) = position.col(count - 1); // a segment of no length
        std::vector<std::array<int, 2>> segments;
        for (int k = 0; k < count; ++k)
            segments.push_back({k, k + 1});
        const SegmentDistance distance(position, segments);
        for (int trial = 0; trial < 300; ++trial) {
            Eigen::Vector2d p(anywhere(random), anywhere(random));
            if (trial % 3 == 0) // on a segment, but for rounding
                p = position.col(trial % count) + 0.3 * (position.col(trial % count + 1) - position.col(trial % count));
            double least = std::numeric_limits<double>::infinity();
            for (const auto& [i, j] : segments) {
                const Eigen::Vector2d a = position.col(i), way = position.col(j) - a;
                const double length = way.squaredNorm(),
                             t = length > 0 ? std::clamp((p - a).dot(way) / length, 0.0, 1.0) : 0;
                least = std::min(least, (p - a - t * way).norm());
            }
            EXPECT_EQ(distance(p), least) << count << " " << trial;
        }
    }
    EXPECT_TRUE(std::isinf(SegmentDistance(Eigen::Matrix2Xd::Zero(2, 3), {})({0, 0})));
}

} // namespace spia
