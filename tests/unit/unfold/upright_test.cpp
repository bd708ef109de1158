#include "engine/unfold/upright.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

namespace spia {
namespace {

Eigen::Vector2d box(const Eigen::Matrix2Xd& flat) { return flat.rowwise().maxCoeff() - flat.rowwise().minCoeff(); }

/// The smallest box with a side along an edge, by trying every edge with all places.
double least_area(const Eigen::Matrix2Xd& rim)
{
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < rim.cols(); ++k) {
        const Eigen::Vector2d way = rim.col((k + 1) % rim.cols()) - rim.col(k);
        const double angle = -std::atan2(way[1], way[0]);
        Eigen::Matrix2d turn;
        turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
        least = std::min(least, box(turn * rim).prod());
    }
    return least;
}

} // namespace

TEST(Upright, HasTheSmallestBoxAlongAnEdgeOfTheOutline)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> far(10, 60), turned(0, 2 * std::numbers::pi);
    for (int trial = 0; trial < 60; ++trial) {
        const int count = 3 + 4 * trial;
        const double start = turned(random);
        Eigen::Matrix2Xd rim(2, count);
        for (int k = 0; k < count; ++k) {
            const double angle = start + 2 * std::numbers::pi * k / count, r = trial % 2 ? far(random) : 40;
            rim.col(k) << 7 + r * std::cos(angle), 2 * r * std::sin(angle) - 3;
        }
        std::vector<int> outline(static_cast<size_t>(count));
        std::iota(outline.begin(), outline.end(), 0);
        const Eigen::Matrix2Xd turned_rim = upright(outline, rim);
        EXPECT_NEAR(box(turned_rim).prod(), least_area(rim), 1e-8 * least_area(rim)) << trial;
        EXPECT_GE(box(turned_rim)[0], box(turned_rim)[1] * (1 - 1e-12)) << trial;
        for (int k = 0; k < count; ++k) // turned, not mirrored or stretched
            EXPECT_NEAR((turned_rim.col(k) - turned_rim.col(0)).norm(), (rim.col(k) - rim.col(0)).norm(), 1e-10);
    }
}

} // namespace spia
