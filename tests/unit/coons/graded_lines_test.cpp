#include "engine/coons/graded_lines.h"

#include <gtest/gtest.h>

namespace spia {
namespace {

constexpr double unbounded = 1e9; // growth

Eigen::VectorXd even(int intervals) { return Eigen::VectorXd::LinSpaced(intervals + 1, 0, intervals) / intervals; }

TEST(GradedLines, IsEvenWhereNothingAsksForMore)
{
    EXPECT_EQ(graded_lines(Eigen::VectorXd::Zero(10), 7, 0.5), even(7));
    EXPECT_EQ(graded_lines(Eigen::VectorXd::LinSpaced(10, 0, 1), 7, 0), even(7));
    EXPECT_LT((graded_lines(Eigen::VectorXd::Constant(10, 3), 7, 0.8) - even(7)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(GradedLines, DealsLinesOutByTheWeight)
{
    Eigen::VectorXd weight = Eigen::VectorXd::Ones(64);
    weight.head(32).setConstant(3);
    const Eigen::VectorXd all = graded_lines(weight, 40, 1, unbounded);
    EXPECT_NEAR(all[30], 0.5, 1e-3); // 30 of 40 in the half of threefold weight
    EXPECT_NEAR(all[1], 0.5 / 30, 1e-4);
    EXPECT_NEAR(all[40] - all[39], 0.5 / 10, 1e-4);
    const Eigen::VectorXd half = graded_lines(weight, 40, 0.5, unbounded);
    EXPECT_NEAR(half[25], 0.5, 1e-3); // 10 + 15
}

TEST(GradedLines, NeighboursDifferByTheGrowthAtMost)
{
    for (const double growth : {1.2, 1.5, 2.0})
        for (const int peak : {0, 31, 63}) {
            Eigen::VectorXd weight = Eigen::VectorXd::Zero(64);
            weight[peak] = 1;
            const int n = 50;
            const Eigen::VectorXd lines = graded_lines(weight, n, 0.7, growth);
            const Eigen::VectorXd width = lines.tail(n) - lines.head(n);
            EXPECT_GT(width.minCoeff(), 0);
            EXPECT_EQ(lines[0], 0);
            EXPECT_EQ(lines[n], 1);
            const Eigen::ArrayXd ratio = width.tail(n - 1).array() / width.head(n - 1).array();
            EXPECT_LT(ratio.maxCoeff(), growth * 1.02);
            EXPECT_GT(ratio.minCoeff(), 1 / (growth * 1.02));
            int there = 0; // 50 / 64 of a line if even
            for (int k = 0; k <= n; ++k)
                there += lines[k] >= peak / 64. && lines[k] <= (peak + 1) / 64.;
            EXPECT_GE(there, 4) << growth << " " << peak;
        }
}

TEST(GradedLines, IsSymmetricWithTheWeight)
{
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(40);
    weight[7] = weight[32] = 2;
    const Eigen::VectorXd lines = graded_lines(weight, 30, 0.6);
    EXPECT_LT((lines + lines.reverse() - Eigen::VectorXd::Ones(31)).cwiseAbs().maxCoeff(), 1e-9);
}

} // namespace
} // namespace spia
