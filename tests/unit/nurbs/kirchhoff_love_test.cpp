// The shell solver of the test support by itself: before anything is proved with it.
#include "tests/support/kirchhoff_love.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "engine/nurbs/curve_fit.h"
#include "engine/nurbs/evaluate.h"
#include "tests/support/joined_patches.h"

namespace spia {
namespace {

using std::numbers::pi;
const auto nothing_held = [](int, const Eigen::Vector3d&) { return std::array{false, false, false}; };

/// A rectangle in the plane z = 0 from x0 to x0 + a, 0 to b.
NurbsSurface plate(double x0, double a, double b, int degree, int spans_u, int spans_v)
{
    const auto even = [](int spans) {
        std::vector<double> border;
        for (int i = 0; i <= spans; ++i)
            border.push_back(double(i) / spans);
        return border;
    };
    NurbsSurface s;
    s.degree_u = s.degree_v = degree;
    s.knots_u = clamped_knots(even(spans_u), degree);
    s.knots_v = clamped_knots(even(spans_v), degree);
    s.count_u = spans_u + degree;
    s.count_v = spans_v + degree;
    s.control.resize(3, s.count_u * s.count_v);
    s.weight = Eigen::VectorXd::Ones(s.control.cols());
    const auto greville = [&](const std::vector<double>& knots, int i) {
        double sum = 0;
        for (int k = 1; k <= degree; ++k)
            sum += knots[size_t(i + k)] / degree;
        return sum;
    };
    for (int j = 0; j < s.count_v; ++j)
        for (int i = 0; i < s.count_u; ++i)
            s.control.col(s.index(i, j)) << x0 + a * greville(s.knots_u, i), b * greville(s.knots_v, j), 0;
    return s;
}

/// A quarter of the Navier series needs odd terms only [Timoshenko & Woinowsky-Krieger, art. 30].
double navier_middle(double q, double a, double D)
{
    double sum = 0;
    for (int m = 1; m < 200; m += 2)
        for (int n = 1; n < 200; n += 2)
            sum += ((m + n) / 2 % 2 == 1 ? 1 : -1) / (double(m) * n * std::pow(m * m + n * n, 2));
    return 16 * q * std::pow(a, 4) / (std::pow(pi, 6) * D) * sum;
}

} // namespace

TEST(KirchhoffLove, AMotionAsARigidBodyCostsNothing)
{
    for (const patches::Sample& sample : patches::samples()) {
        analysis::Shell shell{sample.patches, 0.7, 1000, 0.3, {0, 0, 0}, nothing_held};
        const SharedControls shared = shared_controls(sample.patches);
        Eigen::Matrix3Xd place(3, shared.count), motion(3, shared.count), stretch(3, shared.count);
        for (size_t p = 0; p < sample.patches.patch.size(); ++p)
            for (int c = 0; c < int(sample.patches.patch[p].control.cols()); ++c)
                place.col(shared.of(int(p), c)) = sample.patches.patch[p].control.col(c);
        for (int n = 0; n < shared.count; ++n) {
            motion.col(n) = Eigen::Vector3d(1, -2, 3) + Eigen::Vector3d(0.3, 0.5, -0.2).cross(place.col(n));
            stretch.col(n) = 0.3 * place.col(n);
        }
        const double cost = analysis::energy(shell, stretch);
        EXPECT_GT(cost, 0) << sample.name;
        EXPECT_LT(analysis::energy(shell, motion), 1e-10 * cost) << sample.name;
    }
}

TEST(KirchhoffLove, RefinedPatchesAreTheSameSurface)
{
    for (const patches::Sample& sample : patches::samples()) {
        const MultiPatch finer = analysis::refined(sample.patches, 2);
        for (size_t p = 0; p < finer.patch.size(); ++p)
            for (int n = 0; n < 30; ++n) {
                const double u = n % 6 / 5., v = n / 6 / 4.;
                EXPECT_LT(
                    (evaluate(finer.patch[p], u, v).position - evaluate(sample.patches.patch[p], u, v).position).norm(),
                    1e-11);
            }
    }
}

TEST(KirchhoffLove, ASimplySupportedPlateBendsAsNaviersSeriesAndConvergesInOrder)
{
    const double a = 10, t = 0.1, young = 1e7, nu = 0.3, q = 2, D = young * t * t * t / (12 * (1 - nu * nu));
    const double exact = navier_middle(q, a, D);
    EXPECT_NEAR(exact, 0.00406235 * q * std::pow(a, 4) / D, 1e-6 * exact);
    double last = 0;
    for (const int spans : {2, 4, 8}) {
        analysis::Shell shell{{{plate(0, a, a, 3, spans, spans)}, {}}, t, young, nu, {0, 0, q}, {}};
        shell.held = [&](int, const Eigen::Vector3d& x) {
            const bool border = x[0] < 1e-9 || x[0] > a - 1e-9 || x[1] < 1e-9 || x[1] > a - 1e-9;
            return std::array{border, border, border};
        };
        const double w = analysis::displacement_at(shell, analysis::solve(shell), 0, 0.5, 0.5).z();
        const double error = std::abs(w / exact - 1);
        if (last > 0) {
            EXPECT_GT(std::log2(last / error), 3.5) << spans; // 2 (p - 1) = 4 in bending
        }
        last = error;
    }
    EXPECT_LT(last, 1e-4);
}

TEST(KirchhoffLove, ACantileverOfTwoPatchesBendsAsTheBeamThatItIs)
{
    // Without the stiffness of the joint it would be a mechanism; turned in space nothing changes.
    const double length = 20, width = 3, t = 0.2, young = 1e6, q = 0.7,
                 exact = q * std::pow(length, 4) / (8 * young * t * t * t / 12);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
    for (const Eigen::Matrix3d& frame : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), turn}) {
        MultiPatch two = joined({plate(0, length / 2, width, 3, 4, 2), plate(length / 2, length / 2, width, 3, 4, 2)});
        ASSERT_EQ(two.interfaces.size(), 1u);
        std::vector<char> clamped;
        const SharedControls shared = shared_controls(two);
        clamped.assign(size_t(shared.count), 0);
        for (int j = 0; j < two.patch[0].count_v; ++j)
            for (int i = 0; i < 2; ++i) // two rows: place and slope
                clamped[size_t(shared.of(0, two.patch[0].index(i, j)))] = 1;
        for (NurbsSurface& s : two.patch)
            s.control = frame * s.control;
        analysis::Shell shell{two, t, young, 0, frame * Eigen::Vector3d(0, 0, q), {}, 1e5};
        shell.held = [&](int n, const Eigen::Vector3d&) {
            const bool held = clamped[size_t(n)] != 0;
            return std::array{held, held, held};
        };
        const analysis::Solution solution = analysis::solve(shell);
        const Eigen::Vector3d tip = frame.transpose() * analysis::displacement_at(shell, solution, 1, 1, 0.5);
        EXPECT_NEAR(tip.z() / exact, 1, 1e-4);
        EXPECT_LT(std::abs(tip.x()) + std::abs(tip.y()), 1e-6 * exact);
        shell.hinge_stiffness = 0;
        EXPECT_THROW(analysis::solve(shell), std::runtime_error) << "a hinge across the strip";
    }
}

} // namespace spia
