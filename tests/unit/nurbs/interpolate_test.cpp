#include "engine/nurbs/interpolate.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "engine/core/error.h"
#include "engine/nurbs/evaluate.h"
#include "tests/support/known_surfaces.h"

namespace spia {

namespace {

using Ends = InterpolateOptions::Ends;
using Kind = InterpolateOptions::Parameters;

/// A stamped sheet of 400 x 300 mm with a bulge and a twist, its nodes unevenly spaced; second
/// derivatives do not vanish along the border.
double height(double x, double y) { return 40 * std::exp(-x / 250) * std::cos(y / 70 + 0.3) + 1e-3 * x * y; }

Eigen::Vector3d sheet(double s, double t)
{
    const double x = 400 * (s + 0.05 * std::sin(6 * s) * (1 + t)), y = 300 * (t + 0.1 * t * t * (1 - 0.5 * s));
    return {x, y, height(x, y)};
}

/// Distance of the surface from the sheet along z, which does not depend on the parameters; how
/// much of it at the border.
struct SheetError {
    double anywhere = 0, border = 0;
};

SheetError error_of(const NurbsSurface& surface)
{
    SheetError error;
    const int samples = 400;
    for (int j = 0; j <= samples; ++j)
        for (int i = 0; i <= samples; ++i) {
            const Eigen::Vector3d p = evaluate(surface, double(i) / samples, double(j) / samples).position;
            const double e = std::abs(p.z() - height(p.x(), p.y()));
            error.anywhere = std::max(error.anywhere, e);
            if (i == 0 || j == 0 || i == samples || j == samples)
                error.border = std::max(error.border, e);
        }
    return error;
}

double largest_miss(const QuadGrid& grid, const InterpolateResult& result)
{
    double miss = 0;
    for (int j = 0; j <= grid.rows; ++j)
        for (int i = 0; i <= grid.columns; ++i)
            miss = std::max(miss, (evaluate(result.surface, result.u[size_t(i)], result.v[size_t(j)]).position -
                                   grid.position.col(grid.node(i, j)))
                                      .norm());
    return miss;
}

} // namespace

TEST(Interpolate, SurfaceRunsThroughAllNodes)
{
    for (Ends ends : {Ends::averaged_knots, Ends::clamped, Ends::natural})
        for (Kind kind : {Kind::chord, Kind::centripetal, Kind::uniform})
            for (auto [columns, rows] : {std::pair{1, 1}, {1, 2}, {2, 5}, {3, 3}, {17, 4}, {60, 90}}) {
                const QuadGrid grid = surfaces::grid(columns, rows, sheet);
                const InterpolateResult result = interpolate(grid, {ends, kind});
                EXPECT_LT(largest_miss(grid, result), 1e-12 * 500) << columns << " x " << rows;
                EXPECT_EQ(result.u.front(), 0);
                EXPECT_EQ(result.u.back(), 1);
                EXPECT_EQ(result.coinciding_columns + result.coinciding_rows, 0);
            }
}

TEST(Interpolate, ControlPointsAreAsManyAsNodesOrTwoMoreAsInThePaper)
{
    const QuadGrid grid = surfaces::grid(12, 7, sheet);
    const NurbsSurface averaged = interpolate(grid).surface;
    EXPECT_EQ(averaged.count_u, 13);
    EXPECT_EQ(averaged.count_v, 8);
    EXPECT_EQ(averaged.control.cols(), 13 * 8);
    EXPECT_EQ(averaged.knots_u.size(), 13u + 4u);
    const NurbsSurface natural = interpolate(grid, {Ends::natural}).surface;
    EXPECT_EQ(natural.count_u, 15);
    EXPECT_EQ(natural.count_v, 10);
    EXPECT_EQ(natural.control.cols(), 15 * 10);
    EXPECT_EQ(natural.knots_v.size(), 10u + 4u);
}

TEST(Interpolate, FewNodesLowerTheDegreeAndTwoRowsMakeARuledSurface)
{
    const NurbsSurface s = interpolate(surfaces::grid(2, 1, sheet)).surface;
    EXPECT_EQ(s.degree_u, 2);
    EXPECT_EQ(s.degree_v, 1);
    const Eigen::Vector3d middle = (evaluate(s, 0.3, 0).position + evaluate(s, 0.3, 1).position) / 2;
    EXPECT_LT((evaluate(s, 0.3, 0.5).position - middle).norm(), 1e-12);
}

TEST(Interpolate, EveryDegreeHasItsOrderUpToTheBorderAndClampedEndsKeepIt)
{
    for (const int degree : {2, 3, 4, 5})
        for (const Ends ends : {Ends::averaged_knots, Ends::clamped}) {
            std::vector<SheetError> error;
            for (int cells : {20, 40, 80}) {
                InterpolateOptions options{ends, Kind::uniform};
                options.degree_u = options.degree_v = degree;
                const NurbsSurface surface = interpolate(surfaces::grid(cells, cells, sheet), options).surface;
                EXPECT_EQ(surface.degree_u, degree);
                EXPECT_EQ(surface.count_v, cells + 1 + (ends == Ends::clamped ? 2 : 0));
                error.push_back(error_of(surface));
            }
            const double order = std::log2(error[1].anywhere / error[2].anywhere);
            EXPECT_GT(order, degree + 0.5) << "degree " << degree << ", " << name(ends);
            EXPECT_GT(std::log2(error[1].border / error[2].border), degree + 0.5) << degree << ", " << name(ends);
        }
}

TEST(Interpolate, ClampedEndsGiveBackTheTangentsOfAPolynomial)
{
    const auto quintic = [](double s, double t) {
        return Eigen::Vector3d(300 * s + 40 * std::pow(s, 5), 200 * t - 30 * std::pow(t, 4), 25 * std::pow(s * t, 3));
    };
    InterpolateOptions options{Ends::clamped, Kind::uniform};
    options.degree_u = options.degree_v = 5;
    for (auto [columns, rows] : {std::pair{11, 8}, {5, 6}, {5, 5}}) {
        const InterpolateResult result = interpolate(surfaces::grid(columns, rows, quintic), options);
        for (int i = 0; i <= 30; ++i)
            for (int j = 0; j <= 30; ++j)
                EXPECT_LT((evaluate(result.surface, i / 30., j / 30.).position - quintic(i / 30., j / 30.)).norm(),
                          1e-10 * 300);
        EXPECT_NEAR(evaluate(result.surface, 1, 0).S_u.x(), 500, 1e-7);
    }
    EXPECT_LT(largest_miss(surfaces::grid(2, 3, quintic), interpolate(surfaces::grid(2, 3, quintic), options)), 1e-9);
}

TEST(Interpolate, DegreesThatAreNotOfferedAreRefused)
{
    InterpolateOptions options;
    options.degree_v = 6;
    EXPECT_THROW(interpolate(surfaces::grid(9, 9, sheet), options), InputError);
    options = {Ends::natural};
    options.degree_u = 4;
    EXPECT_THROW(interpolate(surfaces::grid(9, 9, sheet), options), InputError);
}

TEST(Interpolate, BicubicSurfaceIsReproducedUpToTheBorder)
{
    const auto cubic = [](double s, double t) {
        return Eigen::Vector3d(300 * s + 40 * s * s * t - 25 * s * s * s, 200 * t - 30 * t * t * t + 12 * s * t,
                               50 * s * s * s * t * t * t - 80 * s * s * t + 33 * t * t - 5 * s);
    };
    const NurbsSurface surface =
        interpolate(surfaces::grid(11, 8, cubic), {Ends::averaged_knots, Kind::uniform}).surface;
    for (int i = 0; i <= 50; ++i)
        for (int j = 0; j <= 50; ++j)
            EXPECT_LT((evaluate(surface, i / 50., j / 50.).position - cubic(i / 50., j / 50.)).norm(), 1e-12 * 300);
}

TEST(Interpolate, AveragedKnotsHaveOrderFourUpToTheBorderAndNaturalEndsTwo)
{
    std::vector<SheetError> averaged, natural;
    for (int cells : {10, 20, 40, 80}) {
        const QuadGrid grid = surfaces::grid(cells, cells, sheet);
        averaged.push_back(error_of(interpolate(grid).surface));
        natural.push_back(error_of(interpolate(grid, {Ends::natural}).surface));
    }
    const auto order = [](double coarse, double fine) { return std::log2(coarse / fine); };
    EXPECT_GT(order(averaged[2].anywhere, averaged[3].anywhere), 3.7);
    EXPECT_GT(order(averaged[2].border, averaged[3].border), 3.7);
    EXPECT_GT(order(averaged[0].anywhere, averaged[3].anywhere), 3 * 3.5);
    EXPECT_NEAR(order(natural[2].border, natural[3].border), 2, 0.3);
    EXPECT_NEAR(order(natural[2].anywhere, natural[3].anywhere), 2, 0.3);
    EXPECT_GT(natural[3].border, 20 * averaged[3].border);
}

TEST(Interpolate, NaturalEndsHaveNoSecondDerivativeAlongTheBorderNorFourthAtTheCorners)
{
    const NurbsSurface s = interpolate(surfaces::grid(9, 6, sheet), {Ends::natural}).surface;
    double inside = 0;
    for (int i = 0; i <= 30; ++i) {
        const double t = i / 30.;
        EXPECT_LT(evaluate(s, 0, t).S_uu.norm(), 1e-8);
        EXPECT_LT(evaluate(s, 1, t).S_uu.norm(), 1e-8);
        EXPECT_LT(evaluate(s, t, 0).S_vv.norm(), 1e-8);
        EXPECT_LT(evaluate(s, t, 1).S_vv.norm(), 1e-8);
        inside = std::max(inside, evaluate(s, 0.4, t).S_uu.norm());
    }
    EXPECT_GT(inside, 1) << "the sheet is curved";
    // S_vv is zero along v = 0 for all u; S_uuvv at a corner is the second difference of S_vv there
    const double h = 1e-3;
    for (double u : {0., 1.}) {
        const double in = u == 0 ? h : -h;
        const Eigen::Vector3d difference =
            evaluate(s, u, 0).S_vv - 2 * evaluate(s, u + in, 0).S_vv + evaluate(s, u + 2 * in, 0).S_vv;
        EXPECT_LT(difference.norm() / (h * h), 1e-2);
    }
}

TEST(Interpolate, ParametersFollowTheDistancesOfTheNodes)
{
    // columns at x = 0, 1, 5, 14 on all rows; rows evenly spaced
    const double x[] = {0, 1, 5, 14};
    const QuadGrid grid =
        surfaces::grid(3, 2, [&](double s, double t) { return Eigen::Vector3d(x[std::lround(3 * s)], 20 * t, 0); });
    const std::vector<double> chord = interpolate(grid).u;
    const std::vector<double> centripetal = interpolate(grid, {Ends::averaged_knots, Kind::centripetal}).u;
    const std::vector<double> uniform = interpolate(grid, {Ends::averaged_knots, Kind::uniform}).u;
    const double chord_truth[] = {0, 1. / 14, 5. / 14, 1}, centripetal_truth[] = {0, 1. / 6, 3. / 6, 1};
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(chord[i], chord_truth[i], 1e-15);
        EXPECT_NEAR(centripetal[i], centripetal_truth[i], 1e-15);
        EXPECT_NEAR(uniform[i], double(i) / 3, 1e-15);
    }
}

TEST(Interpolate, KnotsAreMeansOfThreeParametersOrTheParametersThemselves)
{
    const double x[] = {0, 1, 3, 7, 15, 20};
    const QuadGrid grid =
        surfaces::grid(5, 2, [&](double s, double t) { return Eigen::Vector3d(x[std::lround(5 * s)], 20 * t, 0); });
    const std::vector<double> averaged = {0, 0, 0, 0, 11. / 60, 25. / 60, 1, 1, 1, 1};
    const std::vector<double> natural = {0, 0, 0, 0, 0.05, 0.15, 0.35, 0.75, 1, 1, 1, 1};
    const NurbsSurface a = interpolate(grid).surface, n = interpolate(grid, {Ends::natural}).surface;
    ASSERT_EQ(a.knots_u.size(), averaged.size());
    ASSERT_EQ(n.knots_u.size(), natural.size());
    for (size_t i = 0; i < averaged.size(); ++i)
        EXPECT_NEAR(a.knots_u[i], averaged[i], 1e-15);
    for (size_t i = 0; i < natural.size(); ++i)
        EXPECT_NEAR(n.knots_u[i], natural[i], 1e-15);
    EXPECT_EQ(a.knots_v, (std::vector<double>{0, 0, 0, 1, 1, 1})) << "three rows: degree 2";
}

TEST(Interpolate, MovedGridGivesTheMovedSurface)
{
    const QuadGrid grid = surfaces::grid(14, 9, sheet);
    QuadGrid moved = grid;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const Eigen::Vector3d shift(100, -50, 30);
    moved.position = (2.5 * turn * grid.position).colwise() + shift;
    for (Ends ends : {Ends::averaged_knots, Ends::natural}) {
        const NurbsSurface before = interpolate(grid, {ends}).surface, after = interpolate(moved, {ends}).surface;
        const Eigen::Matrix3Xd expected = (2.5 * turn * before.control).colwise() + shift;
        EXPECT_LT((after.control - expected).cwiseAbs().maxCoeff(), 1e-10);
    }
    // With given parameters not only similarity: every affine map.
    Eigen::Matrix3d shear;
    shear << 1, 0.7, 0, 0, 2, -0.4, 0.3, 0, 0.5;
    moved.position = (shear * grid.position).colwise() + shift;
    const InterpolateOptions options{Ends::averaged_knots, Kind::uniform};
    const Eigen::Matrix3Xd expected = (shear * interpolate(grid, options).surface.control).colwise() + shift;
    EXPECT_LT((interpolate(moved, options).surface.control - expected).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Interpolate, ExchangedDirectionsGiveTheExchangedSurface)
{
    const QuadGrid grid = surfaces::grid(14, 9, sheet);
    const QuadGrid exchanged = surfaces::grid(9, 14, [](double s, double t) { return sheet(t, s); });
    const NurbsSurface a = interpolate(grid).surface, b = interpolate(exchanged).surface;
    for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 20; ++j)
            EXPECT_LT((evaluate(a, i / 20., j / 20.).position - evaluate(b, j / 20., i / 20.).position).norm(), 1e-10);
}

TEST(Interpolate, SideCollapsedToAPointHasNoSayInTheParameters)
{
    // A triangle: the side v = 0 is one point; all other rows are divided 1 : 3.
    const auto fan = [](double s, double t) {
        return Eigen::Vector3d(100 * t * (s < 0.4 ? 0 : s < 0.6 ? 0.25 : 1), 100 * t, 0);
    };
    const QuadGrid grid = surfaces::grid(2, 6, fan);
    const InterpolateResult result = interpolate(grid);
    EXPECT_NEAR(result.u[1], 0.25, 1e-15);
    EXPECT_EQ(result.coinciding_columns, 0);
    EXPECT_LT(largest_miss(grid, result), 1e-10);
}

TEST(Interpolate, CoincidingNodesAreReportedAndTheSurfaceStillRunsThroughAllNodes)
{
    QuadGrid grid = surfaces::grid(8, 8, sheet);
    for (int j = 0; j <= 8; ++j) // columns 3 and 4 on one line
        grid.position.col(grid.node(4, j)) = grid.position.col(grid.node(3, j));
    for (Ends ends : {Ends::averaged_knots, Ends::natural}) {
        const InterpolateResult result = interpolate(grid, {ends});
        EXPECT_EQ(result.coinciding_columns, 1);
        EXPECT_EQ(result.coinciding_rows, 0);
        EXPECT_TRUE(result.surface.control.allFinite());
        EXPECT_LT(largest_miss(grid, result), 1e-8);
        EXPECT_LT(result.surface.control.cwiseAbs().maxCoeff(), 2000) << "no overshoot";
    }
    const QuadGrid point = surfaces::grid(5, 5, [](double, double) { return Eigen::Vector3d(1, 2, 3); });
    const InterpolateResult result = interpolate(point);
    EXPECT_EQ(result.coinciding_columns, 5);
    EXPECT_EQ(result.coinciding_rows, 5);
    EXPECT_LT((evaluate(result.surface, 0.37, 0.71).position - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
}

TEST(Interpolate, GridThatIsNoGridIsRefused)
{
    QuadGrid grid = surfaces::grid(4, 4, sheet);
    grid.position(1, grid.node(3, 2)) = std::numeric_limits<double>::quiet_NaN();
    try {
        interpolate(grid);
        FAIL() << "a coordinate that is not a number was accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("(3, 2)"), std::string::npos) << error.what();
    }
    EXPECT_THROW(interpolate(QuadGrid{}), InputError);
    grid.columns = 5;
    EXPECT_THROW(interpolate(grid), InputError);
}

} // namespace spia
