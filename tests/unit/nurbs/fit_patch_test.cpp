#include "engine/nurbs/fit_patch.h"

#include <cmath>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/fit_curve.h"
#include "engine/nurbs/span_borders.h"
#include "tests/support/known_surfaces.h"

namespace spia::fit_patch_test {

namespace {

using Eigen::Vector3d;

Vector3d wavy(double x, double y) { return {100 * x, 100 * y, 10 * std::sin(5 * x + 2) * std::cos(4 * y)}; }

Eigen::Matrix3Xd points_at(const std::vector<double>& u, const std::vector<double>& v, double x0, double x1)
{
    Eigen::Matrix3Xd points(3, Eigen::Index(u.size() * v.size()));
    for (size_t j = 0; j < v.size(); ++j)
        for (size_t i = 0; i < u.size(); ++i)
            points.col(Eigen::Index(i + j * u.size())) = wavy(x0 + (x1 - x0) * u[i], v[j]);
    return points;
}

std::vector<double> even(int spans)
{
    std::vector<double> borders;
    for (int i = 0; i <= spans; ++i)
        borders.push_back(double(i) / spans);
    return borders;
}

double order(double coarse, double fine) { return std::log2(coarse / fine); }

Vector3d on_curve(const CurveFitResult& curve, int degree, double t)
{
    const BasisValues N = basis(curve.knots, degree, t);
    Vector3d p = Vector3d::Zero();
    for (int k = 0; k <= degree; ++k)
        p += N.value[size_t(k)] * curve.control.col(N.first + k);
    return p;
}

CurveSource arc()
{
    return [](const std::vector<double>& t) {
        Eigen::Matrix3Xd points(3, Eigen::Index(t.size()));
        for (size_t i = 0; i < t.size(); ++i)
            points.col(Eigen::Index(i)) << 50 * std::cos(2 * t[i]), 50 * std::sin(2 * t[i]), 20 * std::sin(7 * t[i]);
        return points;
    };
}

} // namespace

TEST(FitCurve, LeastSquaresHaveTheOrderOfTheirDegreePlusOne)
{
    for (const int degree : {2, 3, 4, 5})
        for (const CurveEnds ends : {CurveEnds::averaged_knots, CurveEnds::clamped}) {
            std::vector<double> error;
            for (const int spans : {8, 16, 32}) {
                CurveFitOptions options;
                options.degree = degree;
                options.ends = ends;
                const CurveFitResult curve = curve_over(even(spans), arc(), options);
                double largest = 0;
                for (int i = 0; i <= 997; ++i)
                    largest = std::max(largest, (on_curve(curve, degree, i / 997.) - arc()({i / 997.}).col(0)).norm());
                error.push_back(largest);
            }
            EXPECT_GT(order(error[1], error[2]), degree + 0.7) << "degree " << degree << ", " << name(ends);
            EXPECT_LT(error[2], 1e-2);
        }
}

TEST(FitCurve, NaturalEndsHaveNoSecondDerivativeAndOrderTwo)
{
    std::vector<double> error;
    for (const int spans : {16, 32, 64}) {
        CurveFitOptions options;
        options.ends = CurveEnds::natural;
        const CurveFitResult curve = curve_over(even(spans), arc(), options);
        for (const double end : {0., 1.}) {
            const BasisValues N = basis(curve.knots, 3, end);
            Vector3d second = Vector3d::Zero(), first = second;
            for (int k = 0; k <= 3; ++k) {
                second += N.second_derivative[size_t(k)] * curve.control.col(N.first + k);
                first += N.first_derivative[size_t(k)] * curve.control.col(N.first + k);
            }
            EXPECT_LT(second.norm(), 1e-8 * first.norm() * spans);
        }
        double largest = 0;
        for (int i = 0; i <= 997; ++i)
            largest = std::max(largest, (on_curve(curve, 3, i / 997.) - arc()({i / 997.}).col(0)).norm());
        error.push_back(largest);
    }
    EXPECT_NEAR(order(error[1], error[2]), 2, 0.3);
}

TEST(FitCurve, KnotsComeOnlyWhereTheCurveTurns)
{
    // Straight, then a corner at an odd place, then straight again.
    const CurveSource bent = [](const std::vector<double>& t) {
        Eigen::Matrix3Xd points(3, Eigen::Index(t.size()));
        for (size_t i = 0; i < t.size(); ++i)
            points.col(Eigen::Index(i)) << 100 * t[i], 60 * std::max(0., t[i] - 0.63), 0;
        return points;
    };
    CurveFitOptions options;
    options.tolerance = 0.01;
    const CurveFitResult curve = fit_curve(bent, options);
    ASSERT_TRUE(curve.reached);
    EXPECT_LE(curve.largest, 0.01);
    for (size_t s = 0; s + 1 < curve.borders.size(); ++s)
        if (curve.borders[s + 1] - curve.borders[s] < 1. / 64) {
            EXPECT_NEAR(curve.borders[s], 0.63, 0.06);
        }
    EXPECT_LT(curve.borders.size(), 50u);
    for (int i = 0; i <= 3001; ++i) { // across both lines, the corner included
        const Vector3d p = on_curve(curve, 3, i / 3001.);
        const double away = p.x() < 63 ? std::abs(p.y()) : std::abs(p.y() - 0.6 * (p.x() - 63));
        EXPECT_LE(away, 0.0125);
    }
}

TEST(FitPatch, NeighboursThatShareACurveHaveTheSameBorderBitForBit)
{
    const std::vector<double> u = data_parameters(even(4), {}), v = data_parameters(even(8), {});
    const CurveFit along_u(clamped_knots(even(4), 3), 3, CurveEnds::averaged_knots, u);
    const CurveFit along_v(clamped_knots(even(8), 3), 3, CurveEnds::averaged_knots, v);
    const Eigen::Matrix3Xd left = points_at(u, v, 0, 0.4), right = points_at(u, v, 0.4, 1);
    PatchBorders of_left = fit_borders(left, along_u, along_v), of_right = fit_borders(right, along_u, along_v);
    const CurveSource middle = [](const std::vector<double>& t) { return points_at({0.4}, t, 0, 1); };
    // The shared curve is someone else's: it is kept though the data next to it would have it
    // otherwise.
    Eigen::Matrix3Xd shared = curve_over(even(8), middle, {}).control;
    shared.row(2).segment(3, 4).array() += 0.3;
    of_left[1] = of_right[3] = shared;
    const NurbsSurface a = fit_patch(left, along_u, along_v, of_left), b = fit_patch(right, along_u, along_v, of_right);
    for (int j = 0; j < a.count_v; ++j) {
        EXPECT_EQ(a.control.col(a.index(a.count_u - 1, j)), shared.col(j));
        EXPECT_EQ(b.control.col(b.index(0, j)), shared.col(j));
    }
    // Inside they follow their data: the dent of the border fades within two spans.
    EXPECT_LT((evaluate(a, 0.25, 0.5).position - wavy(0.1, 0.5)).norm(), 0.02);
    EXPECT_LT((evaluate(b, 0.75, 0.5).position - wavy(0.85, 0.5)).norm(), 0.05);

    of_left[1].col(0).x() += 1e-13;
    EXPECT_THROW(fit_patch(left, along_u, along_v, of_left), InputError) << "the corner does not meet";
    of_left[1] = shared.leftCols(5);
    EXPECT_THROW(fit_patch(left, along_u, along_v, of_left), InputError);
}

TEST(FitPatch, IsTheLeastSquaresSurfaceAmongThoseWithItsBorder)
{
    // No change of an inner control point makes the weighted sum of squares smaller.
    const std::vector<double> u = data_parameters(even(3), {}), v = data_parameters({0, 0.25, 0.5, 1}, {});
    const CurveFit along_u(clamped_knots(even(3), 3), 3, CurveEnds::averaged_knots, u);
    const CurveFit along_v(clamped_knots({0, 0.25, 0.5, 1}, 2), 2, CurveEnds::averaged_knots, v);
    const Eigen::Matrix3Xd points = points_at(u, v, 0, 1);
    const PatchBorders borders = fit_borders(points, along_u, along_v);
    const auto share = [](const std::vector<double>& t, size_t i) {
        return ((i > 0 ? t[i] - t[i - 1] : 0) + (i + 1 < t.size() ? t[i + 1] - t[i] : 0)) / 2;
    };
    const auto squares = [&](const NurbsSurface& s) {
        double sum = 0;
        // Of the border rows' points only the border curves know: inside the domain every point has
        // its weight.
        for (size_t j = 1; j + 1 < v.size(); ++j)
            for (size_t i = 1; i + 1 < u.size(); ++i)
                sum += share(u, i) * share(v, j) *
                       (evaluate(s, u[i], v[j]).position - points.col(Eigen::Index(i + j * u.size()))).squaredNorm();
        return sum;
    };
    const NurbsSurface best = fit_patch(points, along_u, along_v, borders);
    for (int j = 1; j + 1 < best.count_v; ++j)
        for (int i = 1; i + 1 < best.count_u; ++i)
            for (const double change : {-1e-3, 1e-3}) {
                NurbsSurface other = best;
                other.control(2, best.index(i, j)) += change;
                EXPECT_GT(squares(other), squares(best)) << i << ", " << j;
            }
}

} // namespace spia::fit_patch_test
