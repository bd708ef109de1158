#include "engine/coons/boundary.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "tests/support/shapes.h"
#include "tests/unit/coons/outlines.h"

namespace spia::boundary_test {

namespace {

double length(const std::vector<int>& side, const Blank& blank)
{
    double sum = 0;
    for (size_t i = 1; i < side.size(); ++i)
        sum += (blank.position.col(side[i]) - blank.position.col(side[i - 1])).norm();
    return sum;
}

/// The proposed corners of a flat part, as points.
std::vector<Eigen::Vector2d> proposal(const TriMesh& part)
{
    std::vector<Eigen::Vector2d> points;
    for (const int v : propose_corners(outlines::as_blank(part), part))
        points.push_back(part.position.col(v).head<2>());
    return points;
}

} // namespace

TEST(ProposeCorners, ARectangleHasItsOwnWhateverItsShapeAndPose)
{
    for (const double width : {20.0, 30.0, 200.0})
        for (const double angle : {0.0, 0.4, 2.0}) {
            TriMesh part = shapes::rectangle(width, 20, 40, 16);
            part.position.topRows(2) = Eigen::Rotation2Dd(angle).toRotationMatrix() * part.position.topRows(2);
            std::array<int, 4> corners = propose_corners(outlines::as_blank(part), part);
            std::sort(corners.begin(), corners.end());
            EXPECT_EQ(corners, (std::array<int, 4>{0, 40, 16 * 41, 16 * 41 + 40})) << width << " at " << angle;
        }
}

TEST(ProposeCorners, ACircleIsCutIntoQuarters)
{
    for (const int n : {48, 200, 1001}) {
        const TriMesh part = outlines::part(outlines::circle(10, n));
        const Blank blank = outlines::as_blank(part);
        const BlankBoundary boundary = split_boundary(blank, part, propose_corners(blank, part));
        for (const auto& side : boundary.side)
            EXPECT_NEAR(length(side, blank), 10 * outlines::pi / 2, 1.5 * 2 * outlines::pi * 10 / n) << n;
    }
}

TEST(ProposeCorners, TeethOfAJaggedEdgeAreNoCorners)
{
    for (const auto& corner : proposal(outlines::part(outlines::saw(10, 0.2, 50)))) {
        const Eigen::Vector2d nearest = corner.unaryExpr([](double x) { return x < 5 ? 0.0 : 10.0; });
        EXPECT_LT((corner - nearest).norm(), 0.5) << corner.transpose();
    }
}

TEST(ProposeCorners, RoundedCornersAndTheEndsOfABandAreFound)
{
    outlines::Points rounded;
    for (int k = 0; k < 4; ++k) // a 40 x 20 plate with corners of radius 2
        for (int i = 0; i <= 8; ++i)
            rounded.push_back(Eigen::Vector2d(k == 0 || k == 3 ? 38 : 2, k < 2 ? 18 : 2) +
                              outlines::polar(2, (k + i / 8.0) * outlines::pi / 2));
    for (const auto& corner : proposal(outlines::part(outlines::divided(rounded, 0.5)))) {
        const Eigen::Vector2d sharp(corner.x() < 20 ? 0 : 40, corner.y() < 10 ? 0 : 20);
        EXPECT_LT((corner - sharp).norm(), 1.2) << corner.transpose();
    }
    for (const auto& corner : proposal(outlines::part(outlines::arc(10, 1, 1.9 * outlines::pi, 300, 6))))
        EXPECT_LT(std::min((corner - Eigen::Vector2d(corner.norm() < 10 ? 9.5 : 10.5, 0)).norm(),
                           (corner - outlines::polar(corner.norm() < 10 ? 9.5 : 10.5, 1.9 * outlines::pi)).norm()),
                  1e-9)
            << corner.transpose();
}

TEST(SplitBoundary, SidesRunCounterClockwiseFromCornerToCorner)
{
    const TriMesh part = shapes::rectangle(30, 20, 3, 2); // vertex (i, j) is i + 4 j
    const Blank blank = outlines::as_blank(part);
    const BlankBoundary boundary = split_boundary(blank, part, {3, 11, 8, 0});
    EXPECT_EQ(boundary.corner, (std::array<int, 4>{3, 11, 8, 0}));
    EXPECT_EQ(boundary.side[0], (std::vector<int>{3, 7, 11}));
    EXPECT_EQ(boundary.side[1], (std::vector<int>{11, 10, 9, 8}));
    EXPECT_EQ(boundary.side[3], (std::vector<int>{0, 1, 2, 3}));
    const BlankBoundary clockwise = split_boundary(blank, part, {3, 0, 8, 11});
    EXPECT_EQ(clockwise.corner, boundary.corner);
    EXPECT_EQ(clockwise.side, boundary.side);
}

TEST(SplitBoundary, CornersThatCannotBeAreRefusedWithAdvice)
{
    const TriMesh part = shapes::rectangle(30, 20, 3, 2);
    const Blank blank = outlines::as_blank(part);
    const auto message = [&](std::array<int, 4> corners) {
        try {
            split_boundary(blank, part, corners);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(message({0, 3, 5, 8}).find("vertex 5 is not on the outer boundary"), std::string::npos);
    EXPECT_NE(message({0, 3, 3, 8}).find("vertex 3 is given"), std::string::npos);
    EXPECT_NE(message({0, 11, 3, 8}).find("0,3,11,8"), std::string::npos);
    EXPECT_NE(message({0, 3, 1000, 8}).find("vertex 1000"), std::string::npos);
}

TEST(Boundary, PlacesOnASideGoByLength)
{
    Eigen::Matrix2Xd plane(2, 4);
    plane << 0, 1, 1, 1, 0, 0, 3, 7; // edges of 1, 3 and 4
    const std::vector<int> side = {0, 1, 2, 3};
    const Eigen::VectorXd chord = chord_parameters(side, plane);
    EXPECT_LT((chord - Eigen::Vector4d(0, 0.125, 0.5, 1)).norm(), 1e-15);
    const SidePoint point = point_on_side(side, chord, 0.3125);
    EXPECT_EQ(point.a, 1);
    EXPECT_EQ(point.b, 2);
    EXPECT_DOUBLE_EQ(point.weight, 0.5);
}

TEST(Boundary, MessagesCallVerticesByTheirNumberInTheFile)
{
    const TriMesh part = shapes::rectangle(4, 4, 2, 2);
    std::vector<int> number(size_t(part.vertices()));
    for (size_t v = 0; v < number.size(); ++v)
        number[v] = int(v) + 100;
    const Blank blank{part.position.topRows<2>()};
    try {
        split_boundary(blank, part, {0, 2, 4, 8}, number); // 4 is in the middle
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("vertex 104 "), std::string::npos) << error.what();
    }
}

} // namespace spia::boundary_test
