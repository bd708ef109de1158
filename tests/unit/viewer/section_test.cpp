#include "app/viewer/model/section.h"

#include <gtest/gtest.h>

#include "app/viewer/model/statistics.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"

namespace spia::viewer {

TEST(Section, ThroughALinearFieldIsThatField)
{
    const TriMesh flat = shapes::rectangle(30, 20, 7, 5);
    const Eigen::VectorXd value = (2 * flat.position.row(0) + 3 * flat.position.row(1)).transpose();
    const SectionLine line{{3, 4, 0}, {23, 11, 0}, {0, 0, -1}, false};
    const auto pieces = section(flat, value, line);
    ASSERT_GT(pieces.size(), 5u);
    const double length = (line.to - line.from).norm();
    EXPECT_NEAR(pieces.front().from_distance, 0, 1e-12);
    EXPECT_NEAR(pieces.back().to_distance, length, 1e-12);
    double covered = 0;
    for (const SectionPiece& piece : pieces) {
        covered += piece.to_distance - piece.from_distance;
        for (const auto& [place, distance, v] : {std::tuple(piece.from, piece.from_distance, piece.from_value),
                                                 std::tuple(piece.to, piece.to_distance, piece.to_value)}) {
            EXPECT_LT((place - (line.from + distance / length * (line.to - line.from))).norm(), 1e-12);
            EXPECT_NEAR(v, 2 * place[0] + 3 * place[1], 1e-12);
        }
    }
    EXPECT_NEAR(covered, length, 1e-9); // no gap, nothing twice
}

TEST(Section, OfADomeFollowsItsMeridian)
{
    shapes::Dome shape;
    shape.triangles = 4000;
    const TriMesh part = shapes::dome(shape).mesh;
    const Eigen::VectorXd height = part.position.row(2);
    const double reach = part.position.row(0).maxCoeff();
    const auto pieces = section(part, height, {{-reach, 0.1, 99}, {reach, 0.1, 99}, {0, 0, -1}, false});
    ASSERT_FALSE(pieces.empty());
    double highest = -1e9;
    for (const SectionPiece& piece : pieces) {
        EXPECT_NEAR(piece.from[1], 0.1, 1e-9);
        EXPECT_NEAR(piece.from_value, piece.from[2], 1e-9);
        highest = std::max(highest, piece.to_value);
    }
    EXPECT_NEAR(highest, height.maxCoeff(), 0.01 * reach);
}

TEST(Statistics, AHistogramSharesOutTheArea)
{
    const TriMesh flat = shapes::rectangle(30, 20, 6, 5);
    Eigen::VectorXd value(flat.triangles());
    for (int f = 0; f < flat.triangles(); ++f) // 0 on the left third, 1 on the rest
        value[f] = (flat.position(0, flat.triangle(0, f)) + flat.position(0, flat.triangle(1, f)) +
                    flat.position(0, flat.triangle(2, f))) /
                       3 >
                   10;
    const Histogram h = histogram(flat, value, 4);
    EXPECT_EQ(h.least, 0);
    EXPECT_EQ(h.greatest, 1);
    EXPECT_NEAR(h.share[0], 1. / 3, 1e-12);
    EXPECT_NEAR(h.share[3], 2. / 3, 1e-12);
    EXPECT_EQ(h.share[1] + h.share[2], 0);
}

TEST(Statistics, WorstSpotsAreTheGreatestOfTheirSurroundings)
{
    const TriMesh flat = shapes::rectangle(100, 100, 40, 40);
    Eigen::VectorXd value(flat.triangles());
    const Eigen::Vector2d peak[] = {{20, 30}, {80, 70}};
    for (int f = 0; f < flat.triangles(); ++f) {
        Eigen::Vector2d middle = Eigen::Vector2d::Zero();
        for (int a = 0; a < 3; ++a)
            middle += flat.position.col(flat.triangle(a, f)).head<2>() / 3;
        value[f] =
            2 * std::exp(-(middle - peak[0]).squaredNorm() / 50) + std::exp(-(middle - peak[1]).squaredNorm() / 50);
    }
    const auto spots = worst_spots(flat, value, 2, false);
    ASSERT_EQ(spots.size(), 2u);
    EXPECT_EQ(value[spots[0]], value.maxCoeff());
    EXPECT_GT(value[spots[1]], 0.1);
    const auto near = [&](int f, const Eigen::Vector2d& at) {
        return (flat.position.col(flat.triangle(0, f)).head<2>() - at).norm();
    };
    EXPECT_LT(near(spots[0], peak[0]), 5);
    EXPECT_GT((flat.position.col(flat.triangle(0, spots[1])) - flat.position.col(flat.triangle(0, spots[0]))).norm(),
              12);
    EXPECT_EQ(value[worst_spots(flat, value, 1, true)[0]], value.minCoeff());
}

TEST(Statistics, TheThinnestTheMostSqueezedAndTheFarthestOffAreTheWorst)
{
    EXPECT_GT(badness(Field::thickness, 0.7), badness(Field::thickness, 0.9));
    EXPECT_GT(badness(Field::thinning, 20), badness(Field::thinning, -30));
    EXPECT_GT(badness(Field::strain_minor, -0.3), badness(Field::strain_minor, 0.1));
    EXPECT_GT(badness(Field::deviation, -3), badness(Field::deviation, 2));
}

} // namespace spia::viewer
