#include "engine/nurbs/equidistributed_spans.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/nurbs/curve_fit.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/fit_patch.h"
#include "engine/nurbs/span_borders.h"

namespace spia {
namespace {

/// The least squares bicubic surface of z = f(x) over [0, 1] x [0, 1], with a cubic along y.
NurbsSurface ridge(const std::vector<double>& borders, const std::function<double(double)>& f)
{
    std::vector<double> u, v;
    for (int i = 0; i <= 400; ++i)
        u.push_back(i / 400.);
    for (int i = 0; i <= 8; ++i)
        v.push_back(i / 8.);
    Eigen::Matrix3Xd points(3, Eigen::Index(u.size() * v.size()));
    for (size_t j = 0; j < v.size(); ++j)
        for (size_t i = 0; i < u.size(); ++i)
            points.col(Eigen::Index(i + j * u.size())) << u[i], v[j], f(u[i]);
    const CurveFit along_u(clamped_knots(borders, 3), 3, CurveEnds::averaged_knots, u),
        along_v(clamped_knots({0, 1}, 3), 3, CurveEnds::averaged_knots, v);
    return fit_patch(points, along_u, along_v, fit_borders(points, along_u, along_v));
}

double error(const NurbsSurface& surface, const std::function<double(double)>& f)
{
    double worst = 0;
    for (int i = 0; i <= 997; ++i) {
        const Eigen::Vector3d at = evaluate(surface, i / 997., 0.4).position;
        worst = std::max(worst, std::abs(at.z() - f(at.x())));
    }
    return worst;
}

std::vector<double> evenly(int spans)
{
    std::vector<double> borders;
    for (int i = 0; i <= spans; ++i)
        borders.push_back(double(i) / spans);
    return borders;
}

} // namespace

TEST(EquidistributedSpans, OfASurfaceThatChangesAlikeEverywhereAreAlike)
{
    const auto wave = [](double x) {
        return 0.01 * std::exp(4 * x);
    };                          // the root of fourth order of its derivative is exp(x)
    std::vector<double> uneven; // what is known of it does not depend on where it is known from
    for (int k = 0; k <= 48; ++k)
        uneven.push_back(k <= 32 ? k / 64. : 0.5 + (k - 32) / 32.);
    const std::vector<double> borders = equidistributed_spans(ridge(uneven, wave), true, 8);
    ASSERT_EQ(borders.size(), 9u);
    EXPECT_EQ(borders.front(), 0);
    EXPECT_EQ(borders.back(), 1);
    for (int k = 0; k <= 8; ++k)
        EXPECT_NEAR(borders[size_t(k)], std::log(1 + k / 8. * (std::exp(1) - 1)), 0.01) << k;
    const std::vector<double> across = equidistributed_spans(ridge(uneven, wave), false, 3);
    for (size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(across[k], double(k) / 3, 1e-12) << "one span: nothing is known";
}

TEST(EquidistributedSpans, AKnotIsNoticedByTheStepOfItsHighestDerivative)
{
    const auto kinks = [](double x) { // cubics, with steps of 6 and of 0.6 in their third
                                      // derivative
        return std::pow(std::max(0., x - 0.5), 3) - 0.1 * std::pow(std::max(0., x - 0.75), 3);
    };
    const std::vector<double> significance = knot_significance(ridge({0, 0.25, 0.5, 0.75, 0.875, 1}, kinks), true);
    ASSERT_EQ(significance.size(), 4u);
    EXPECT_NEAR(significance[0], 0, 1e-9);
    EXPECT_NEAR(significance[1], 6 * std::pow(0.125, 3), 1e-9);
    EXPECT_NEAR(significance[2], 0.6 * std::pow(0.25 * 0.125 / 0.375, 3), 1e-9);
    EXPECT_NEAR(significance[3], 0, 1e-9);
    EXPECT_TRUE(knot_significance(ridge({0, 1}, kinks), true).empty());
}

TEST(EquidistributedSpans, NeedFewerForAStepThanEvenOnes)
{
    const auto step = [](double x) { return 0.2 * std::tanh(15 * (x - 0.37)); };
    const NurbsSurface fine = ridge(evenly(32), step);
    for (const int spans : {10, 14}) {
        const std::vector<double> borders = equidistributed_spans(fine, true, spans);
        for (size_t k = 0; k + 1 < borders.size(); ++k)
            EXPECT_LT(borders[k], borders[k + 1]);
        EXPECT_LT(error(ridge(borders, step), step), error(ridge(evenly(spans), step), step) / 5) << spans;
    }
}

} // namespace spia
