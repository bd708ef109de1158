#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/mesh/doctor/doctor.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/trim.h"
#include "tests/support/known_surfaces.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

using std::numbers::pi;

/// The plane z = 0 from 0 to the sizes, mm.
NurbsSurface plane(double width, double height)
{
    return surfaces::bilinear({0, 0, 0}, {width, 0, 0}, {0, height, 0}, {width, height, 0});
}

/// A ring of triangles around a closed polygon in the plane: its inner border is the polygon, the
/// outer one twice as large.
TriMesh ring(const std::vector<Eigen::Vector2d>& hole)
{
    const int n = int(hole.size());
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& p : hole)
        middle += p / n;
    TriMesh mesh;
    mesh.position = Eigen::Matrix3Xd::Zero(3, 2 * n);
    mesh.triangle.resize(3, 2 * n);
    for (int i = 0; i < n; ++i) {
        mesh.position.col(i).head<2>() = hole[size_t(i)];
        mesh.position.col(n + i).head<2>() = middle + 2 * (hole[size_t(i)] - middle);
        const int next = (i + 1) % n;
        mesh.triangle.col(2 * i) << i, n + i, n + next;
        mesh.triangle.col(2 * i + 1) << i, n + next, next;
    }
    return mesh;
}

std::vector<Eigen::Vector2d> circle(int n, double radius, const Eigen::Vector2d& middle)
{
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < n; ++i)
        points.push_back(middle + radius * Eigen::Vector2d(std::cos(2 * pi * i / n), std::sin(2 * pi * i / n)));
    return points;
}

/// mm2 in a plane of that size, positive if the loop runs counter-clockwise.
double area_of(const TrimLoop& loop, double width, double height)
{
    double area = 0;
    for (const PlaneCurve& curve : loop)
        for (int i = 0; i < 1000; ++i) {
            const Eigen::Vector2d a = evaluate(curve, i / 1000.), b = evaluate(curve, (i + 1) / 1000.);
            area += (a.x() * b.y() - a.y() * b.x()) / 2 * width * height;
        }
    return area;
}

void expect_closed(const TrimLoop& loop)
{
    for (size_t i = 0; i < loop.size(); ++i)
        EXPECT_EQ(evaluate(loop[i], 1), evaluate(loop[(i + 1) % loop.size()], 0)) << "curve " << i;
}

} // namespace

TEST(Trim, ACircleOfVerticesBecomesSmoothCurves)
{
    const TriMesh mesh = ring(circle(64, 10, {50, 30}));
    const TrimResult trim = trim_holes(mesh, 64, plane(100, 60), {.tolerance = 1e-3});
    ASSERT_EQ(trim.loop.size(), 1u);
    EXPECT_TRUE(trim.left_filled.empty());
    EXPECT_EQ(trim.loop[0].size(), 2u) << "no corner: two halves";
    expect_closed(trim.loop[0]);
    EXPECT_LT(trim.distance, 1e-3);
    double farthest = 0;
    for (const PlaneCurve& curve : trim.loop[0]) {
        EXPECT_EQ(curve.degree, 3);
        for (int i = 0; i <= 100; ++i) {
            const Eigen::Vector2d p = evaluate(curve, i / 100.).cwiseProduct(Eigen::Vector2d(100, 60));
            farthest = std::max(farthest, std::abs((p - Eigen::Vector2d(50, 30)).norm() - 10));
        }
    }
    EXPECT_LT(farthest, 2e-3) << "the chords of the 64-gon are 0.012 mm off";
    EXPECT_NEAR(area_of(trim.loop[0], 100, 60), -pi * 100, 0.1) << "clockwise: the surface lies to the left";
}

TEST(Trim, CornersStayAndStraightSidesAreStraight)
{
    std::vector<Eigen::Vector2d> square;
    for (int i = 0; i < 10; ++i)
        square.emplace_back(40 + 2 * i, 20);
    for (int i = 0; i < 10; ++i)
        square.emplace_back(60, 20 + 2 * i);
    for (int i = 0; i < 10; ++i)
        square.emplace_back(60 - 2 * i, 40);
    for (int i = 0; i < 10; ++i)
        square.emplace_back(40, 40 - 2 * i);
    const TrimResult trim = trim_holes(ring(square), 40, plane(100, 60));
    ASSERT_EQ(trim.loop.size(), 1u);
    EXPECT_EQ(trim.loop[0].size(), 4u);
    expect_closed(trim.loop[0]);
    EXPECT_LT(trim.distance, 1e-9);
    EXPECT_NEAR(area_of(trim.loop[0], 100, 60), -400, 1e-6);
}

TEST(Trim, FewVerticesAreAPolygon)
{
    const TrimResult trim = trim_holes(ring(circle(5, 10, {50, 30})), 5, plane(100, 60));
    ASSERT_EQ(trim.loop.size(), 1u);
    EXPECT_EQ(trim.loop[0].size(), 5u);
    EXPECT_NEAR(area_of(trim.loop[0], 100, 60), -5 * 50 * std::sin(2 * pi / 5), 1e-6);
    EXPECT_LT(trim.distance, 1e-9);
}

TEST(Trim, APartSeenFromBelowIsTrimmedTheSameWay)
{
    TriMesh mesh = ring(circle(64, 10, {50, 30}));
    mesh.triangle.row(1).swap(mesh.triangle.row(2));
    const TrimResult trim = trim_holes(mesh, 64, plane(100, 60));
    ASSERT_EQ(trim.loop.size(), 1u);
    EXPECT_LT(area_of(trim.loop[0], 100, 60), 0);
}

TEST(Trim, HolesThatTouchTheBorderOrEachOtherStayFilled)
{
    const auto why = [](const TriMesh& mesh, int outer) {
        const TrimResult trim = trim_holes(mesh, outer, plane(100, 60));
        return trim.left_filled.empty() ? std::string() : trim.left_filled[0].why;
    };
    EXPECT_EQ(why(ring(circle(32, 10, {50, 30})), 32), "");
    EXPECT_NE(why(ring(circle(32, 10, {95, 30})), 32).find("that of the surface"), std::string::npos)
        << "feet beyond the surface lie on its border";
    TriMesh both = ring(circle(32, 10, {40, 30}));
    const TriMesh other = ring(circle(32, 10, {55, 30}));
    const Eigen::Index v = both.position.cols(), f = both.triangle.cols();
    both.position.conservativeResize(3, 2 * v);
    both.position.rightCols(v) = other.position;
    both.triangle.conservativeResize(3, 2 * f);
    both.triangle.rightCols(f) = other.triangle.array() + int(v);
    EXPECT_NE(why(both, 32).find("another hole"), std::string::npos);
    EXPECT_THROW(trim_holes(both, 32, plane(100, 60), {.tolerance = 0}), InputError);
}

TEST(Trim, AHolePinchedToAPointIsTrimmedOnBothSidesOfIt)
{
    // A grid of 6 x 6 squares without two that have a corner in common, which is a vertex on each
    // side as the doctor leaves it.
    for (const bool middle : {false, true}) { // of three in a row
        PolygonSoup soup;
        for (int j = 0; j <= 6; ++j)
            for (int i = 0; i <= 6; ++i)
                soup.position.emplace_back(10 * i, 10 * j, 0);
        for (int j = 0; j < 6; ++j)
            for (int i = 0; i < 6; ++i)
                if (!(i == j && (i == 2 || i == 3 || (middle && i == 1)))) {
                    const int a = 7 * j + i;
                    soup.add_polygon(std::array{a, a + 1, a + 8, a + 7});
                }
        const Examination examination = examine(soup, {});
        ASSERT_TRUE(examination.report.healthy());
        const TrimResult trim = trim_holes(examination.mesh, 0, plane(60, 60));
        EXPECT_TRUE(trim.left_filled.empty());
        ASSERT_EQ(trim.loop.size(), middle ? 3u : 2u);
        double apart = 1; // of corners of two loops
        for (const PlaneCurve& a : trim.loop[0])
            for (const PlaneCurve& b : trim.loop[1])
                apart = std::min(apart, (a.control.col(0) - b.control.col(0)).norm() * 60);
        EXPECT_NEAR(apart, 0.002, 1e-6) << "CAD kernels take no borders that touch";
        for (const TrimLoop& loop : trim.loop) {
            expect_closed(loop);
            EXPECT_NEAR(area_of(loop, 60, 60), -100, 0.05);
        }
    }
}

TEST(Trim, ASheetWithoutHolesHasNone)
{
    EXPECT_TRUE(trim_holes(shapes::rectangle(10, 10, 2, 2), 0, plane(10, 10)).loop.empty());
}

} // namespace spia
