#include "engine/nurbs/certificate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

#include "engine/core/error.h"
#include "engine/nurbs/bezier.h"
#include "engine/nurbs/evaluate.h"
#include "tests/support/joined_patches.h"
#include "tests/support/known_surfaces.h"

namespace spia {
namespace {

constexpr double degrees = M_PI / 180;

PatchCertificate of(const NurbsSurface& surface) { return certify({{surface}, {}}).patch.at(0); }

/// A surface of even clamped knots with control points at a function of (i, j) / (count - 1).
NurbsSurface net(int degree, int count, const std::function<Eigen::Vector3d(double s, double t)>& place)
{
    NurbsSurface s;
    s.degree_u = s.degree_v = degree;
    s.count_u = s.count_v = count;
    s.knots_u.assign(size_t(degree) + 1, 0);
    for (int k = 1; k < count - degree; ++k)
        s.knots_u.push_back(double(k) / (count - degree));
    s.knots_u.insert(s.knots_u.end(), size_t(degree) + 1, 1);
    s.knots_v = s.knots_u;
    s.control.resize(3, count * count);
    s.weight.setOnes(count * count);
    for (int j = 0; j < count; ++j)
        for (int i = 0; i < count; ++i)
            s.control.col(s.index(i, j)) = place(i / (count - 1.), j / (count - 1.));
    return s;
}

/// One cubic span along u, x(u) = a u^3 + b u^2 + c u, in the plane z = 0; y = v.
NurbsSurface strip(double a, double b, double c)
{
    NurbsSurface s;
    s.degree_u = 3;
    s.degree_v = 1;
    s.count_u = 4;
    s.count_v = 2;
    s.knots_u = {0, 0, 0, 0, 1, 1, 1, 1};
    s.knots_v = {0, 0, 1, 1};
    s.control.resize(3, 8);
    s.weight.setOnes(8);
    const double x[] = {0, c / 3, 2 * c / 3 + b / 3, a + b + c};
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 4; ++i)
            s.control.col(s.index(i, j)) << x[i], j, 0;
    return s;
}

TEST(Bezier, NumeratorIsTheCrossProductTimesTheCubeOfTheWeight)
{
    const NurbsSurface s = surfaces::crooked();
    const int span_u = 4, span_v = 3; // from 0.2 to 0.55 and from 0.3 to 0.4
    const BezierPatch h = bezier_of(s, span_u, span_v), A = rows(h, 0, 3), w = rows(h, 3, 1);
    const BezierPatch M =
        sum(times(w, cross(derivative_s(A), derivative_t(A))),
            sum(times(derivative_t(w), cross(A, derivative_s(A))), times(derivative_s(w), cross(derivative_t(A), A))));
    EXPECT_EQ(M.degree_s, 8);
    EXPECT_EQ(M.degree_t, 5);
    // A corner's coefficient is the value there; halves have corners at other places.
    const auto expect = [&](const Eigen::VectorXd& homogeneous, const Eigen::Vector3d& product, double u, double v) {
        const SurfacePoint at = evaluate(s, u, v);
        const double weight = homogeneous[3];
        EXPECT_LT((homogeneous.head<3>() / weight - at.position).norm(), 1e-12);
        const Eigen::Vector3d wanted = at.S_u.cross(at.S_v) * std::pow(weight, 3) * 0.35 * 0.1;
        EXPECT_LT((product - wanted).norm(), 1e-12 * wanted.norm());
    };
    expect(h.at(0, 0), M.at(0, 0), 0.2, 0.3);
    expect(h.at(3, 2), M.at(8, 5), 0.55, 0.4);
    expect(half_s(h, true).at(0, 0), half_s(M, true).at(0, 0), 0.375, 0.3);
    expect(half_s(h, false).at(3, 2), half_s(M, false).at(8, 5), 0.375, 0.4);
    expect(half_t(half_s(h, false), true).at(0, 0), half_t(half_s(M, false), true).at(0, 0), 0.2, 0.35);
    expect(half_t(half_s(h, true), false).at(0, 2), half_t(half_s(M, true), false).at(0, 5), 0.375, 0.35);
}

TEST(Certificate, OfARectangleAndAParallelogramIsKnown)
{
    const PatchCertificate flat = of(net(3, 6, [](double s, double t) { return Eigen::Vector3d(40 * s, 10 * t, 3); }));
    EXPECT_FALSE(flat.refusal);
    EXPECT_EQ(flat.pieces, 9);
    const PatchCertificate even = of(strip(0, 0, 40)); // x = 40 u, y = v
    EXPECT_NEAR(even.proved_jacobian, 40, 1e-10);
    EXPECT_NEAR(even.least_jacobian, 40, 1e-10);
    EXPECT_NEAR(even.greatest_jacobian, 40, 1e-10);
    EXPECT_NEAR(even.least_scaled, 1, 1e-14);
    EXPECT_NEAR(even.orthogonality, 0, 1e-14);
    EXPECT_NEAR(even.condition, (40 * 40 + 1) / (2 * 40.), 1e-10);
    EXPECT_NEAR(even.aspect, 40, 1e-10);
    const double angle = 35 * degrees;
    NurbsSurface slanted = strip(0, 0, 5);
    for (int i = 0; i < 4; ++i)
        slanted.control.col(slanted.index(i, 1)) =
            slanted.control.col(slanted.index(i, 0)) + 5 * Eigen::Vector3d(std::cos(angle), 0, std::sin(angle));
    const PatchCertificate skew = of(slanted);
    EXPECT_NEAR(skew.proved_jacobian, 25 * std::sin(angle), 1e-10);
    EXPECT_NEAR(skew.least_scaled, std::sin(angle), 1e-13);
    EXPECT_NEAR(skew.mean_scaled, std::sin(angle), 1e-13);
    EXPECT_NEAR(skew.orthogonality, std::pow(std::cos(angle), 2), 1e-13);
    EXPECT_NEAR(skew.condition, 1 / std::sin(angle), 1e-13);
    EXPECT_NEAR(skew.aspect, 1, 1e-13);
}

TEST(Certificate, NeighboursCompareByTheirAreas)
{
    // Spans of x from 0 to 1, to 4, to 6: areas 1, 3, 2.
    NurbsSurface s = net(1, 4, [](double a, double b) { return Eigen::Vector3d(a, b, 0); });
    const double x[] = {0, 1, 4, 6};
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            s.control(0, s.index(i, j)) = x[i];
    EXPECT_NEAR(of(s).neighbour_area, 3, 1e-12);
    EXPECT_NEAR(of(patches::exchanged(s)).neighbour_area, 3, 1e-12);
    EXPECT_NEAR(of(s).aspect, 9, 1e-12); // 3 by 1/3
}

TEST(Certificate, BoundsTheJacobianOfRoundSurfaces)
{
    for (const NurbsSurface& s : {surfaces::quarter_cylinder(30, 50), surfaces::sphere_patch(20)}) {
        const PatchCertificate c = of(s);
        EXPECT_FALSE(c.refusal);
        double least = 1e9;
        for (int j = 0; j <= 100; ++j)
            for (int i = 0; i <= 100; ++i) {
                const SurfacePoint at = evaluate(s, i / 100., j / 100.);
                least = std::min(least, at.S_u.cross(at.S_v).norm());
            }
        EXPECT_LE(c.proved_jacobian, least);
        EXPECT_GT(c.proved_jacobian, 0.2 * least) << "the bound is not idle";
        EXPECT_GE(c.least_jacobian, least - 1e-9);
        EXPECT_NEAR(c.least_scaled, 1, s.count_v == 2 ? 1e-12 : 0.2);
    }
}

TEST(Certificate, DoesNotDependOnPlaceDirectionOrParameters)
{
    const NurbsSurface s = surfaces::crooked();
    const PatchCertificate c = of(s);
    ASSERT_FALSE(c.refusal);
    NurbsSurface moved = s;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    moved.control = (2 * turn * s.control).colwise() + Eigen::Vector3d(100, -50, 30);
    const PatchCertificate m = of(moved);
    EXPECT_NEAR(m.proved_jacobian / c.proved_jacobian, 4, 1e-9);
    EXPECT_NEAR(m.least_jacobian / c.least_jacobian, 4, 1e-9);
    for (const NurbsSurface& other : {moved, patches::mirrored_u(s), patches::exchanged(s)}) {
        const PatchCertificate o = of(other);
        EXPECT_FALSE(o.refusal);
        EXPECT_EQ(o.pieces, c.pieces);
        EXPECT_NEAR(o.least_scaled, c.least_scaled, 1e-10);
        EXPECT_NEAR(o.mean_scaled, c.mean_scaled, 1e-10);
        EXPECT_NEAR(o.orthogonality, c.orthogonality, 1e-10);
        EXPECT_NEAR(o.condition, c.condition, 1e-8);
        EXPECT_NEAR(o.aspect, c.aspect, 1e-9);
        EXPECT_NEAR(o.neighbour_area, c.neighbour_area, 1e-9);
    }
}

TEST(Certificate, RefusesAFoldAndSaysWhere)
{
    // A flat net in which one row of control points is pulled back over its neighbours.
    NurbsSurface s = net(3, 8, [](double a, double b) { return Eigen::Vector3d(70 * a, 70 * b, 0); });
    s.control.col(s.index(4, 3)) += Eigen::Vector3d(-60, 0, 0);
    const PatchCertificate c = of(s);
    ASSERT_TRUE(c.refusal);
    EXPECT_EQ(c.refusal->why, Refusal::Why::folded);
    // There S_u x S_v changes its side.
    double low = 1e9, high = -1e9;
    for (int j = -20; j <= 20; ++j)
        for (int i = -20; i <= 20; ++i) {
            const SurfacePoint at = evaluate(s, c.refusal->place.u + i * 1e-4, c.refusal->place.v + j * 1e-4);
            low = std::min(low, at.S_u.cross(at.S_v).z());
            high = std::max(high, at.S_u.cross(at.S_v).z());
        }
    EXPECT_LT(low, 0);
    EXPECT_GT(high, 0);
    EXPECT_LT((c.refusal->place.position - evaluate(s, c.refusal->place.u, c.refusal->place.v).position).norm(), 1e-12);
    EXPECT_NE(describe(*c.refusal).find("folds at u = "), std::string::npos);
}

TEST(Certificate, FindsAFoldBetweenTheSamples)
{
    const double c = 0.4321;
    for (const double half_width : {0.02, 0.005, 0.002}) {
        // x' = (u - c)^2 - half_width^2: back for a moment, where no sample lies
        const NurbsSurface s = strip(1 / 3., -c, c * c - half_width * half_width);
        const PatchCertificate certificate = of(s);
        EXPECT_GT(certificate.least_jacobian, 1e-3) << "no sample sees it";
        ASSERT_TRUE(certificate.refusal);
        EXPECT_NEAR(certificate.refusal->place.u, c, half_width + 1e-3);
        EXPECT_EQ(certificate.refusal->why, Refusal::Why::folded);
        // The same dip, above zero: proved, with a bound below it.
        const PatchCertificate sound = of(strip(1 / 3., -c, c * c + half_width * half_width));
        EXPECT_FALSE(sound.refusal);
        EXPECT_GT(sound.pieces, 1);
        EXPECT_GT(sound.proved_jacobian, 0);
        EXPECT_LE(sound.proved_jacobian, half_width * half_width * (1 + 1e-9));
    }
}

TEST(Certificate, AgreesWithDenseSamplesOfRandomNets)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> by(-1, 1);
    int proved = 0, folded = 0;
    for (int round = 0; round < 120; ++round) {
        const double amount = 0.18 * (round % 4 + 1);
        NurbsSurface s = net(round % 3 + 1, 6, [&](double a, double b) {
            return Eigen::Vector3d(5 * a + amount * by(random), 5 * b + amount * by(random), 0);
        });
        if (round % 2)
            for (double& w : s.weight)
                w = 1 + 0.4 * by(random);
        const PatchCertificate c = of(s);
        double low = 1e9, high = -1e9;
        for (int j = 0; j <= 120; ++j)
            for (int i = 0; i <= 120; ++i) {
                const SurfacePoint at = evaluate(s, i / 120., j / 120.);
                low = std::min(low, at.S_u.cross(at.S_v).z());
                high = std::max(high, at.S_u.cross(at.S_v).z());
            }
        if (c.refusal) {
            ++folded;
            EXPECT_LT(low, 0.05 * high) << "round " << round << ": " << describe(*c.refusal);
        } else {
            ++proved;
            EXPECT_GT(low, 0) << round;
            EXPECT_LE(c.proved_jacobian, low * (1 + 1e-9)) << round;
        }
        if (low < 0) {
            EXPECT_TRUE(c.refusal) << round;
        }
    }
    EXPECT_GT(proved, 20);
    EXPECT_GT(folded, 20);
}

TEST(Certificate, RefusesACollapsedSideAndTwoDirectionsThatBecomeOne)
{
    NurbsSurface fan = strip(0, 0, 10);
    for (int i = 0; i < 4; ++i)
        fan.control.col(fan.index(i, 0)).setZero();
    const PatchCertificate c = of(fan);
    ASSERT_TRUE(c.refusal);
    EXPECT_EQ(c.refusal->why, Refusal::Why::vanishes);
    EXPECT_NEAR(c.refusal->place.v, 0, 1e-3);
    EXPECT_TRUE(std::isinf(c.condition));
    EXPECT_EQ(c.least_scaled, 0);
    NurbsSurface line = strip(0, 0, 10); // both along x
    for (int i = 0; i < 4; ++i)
        line.control.col(line.index(i, 1)) = line.control.col(line.index(i, 0)) + 3 * Eigen::Vector3d::UnitX();
    EXPECT_TRUE(of(line).refusal);
}

TEST(Certificate, AKinkMayTurnByLessThanNinetyDegrees)
{
    for (const double angle : {60., 89., 91., 120., 180.}) {
        NurbsSurface s; // two flat pieces that meet in a knot of the degree's multiplicity
        s.degree_u = 2;
        s.degree_v = 1;
        s.count_u = 5;
        s.count_v = 2;
        s.knots_u = {0, 0, 0, 0.5, 0.5, 1, 1, 1};
        s.knots_v = {0, 0, 1, 1};
        s.control.resize(3, 10);
        s.weight.setOnes(10);
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 5; ++i) {
                const double along = i < 2 ? 0 : i - 2;
                s.control.col(s.index(i, j)) << std::min(i, 2) + along * std::cos(angle * degrees), j,
                    along * std::sin(angle * degrees);
            }
        for (const NurbsSurface& each : {s, patches::exchanged(s)}) {
            const PatchCertificate c = of(each);
            EXPECT_EQ(c.refusal.has_value(), angle > 90) << angle;
            if (c.refusal) {
                EXPECT_EQ(c.refusal->why, Refusal::Why::sharp_edge);
                EXPECT_LT((c.refusal->place.position - Eigen::Vector3d(2, c.refusal->place.position.y(), 0)).norm(),
                          1e-12);
            }
        }
    }
}

TEST(Certificate, MeasuresTheAngleOverAnInterface)
{
    const NurbsSurface left = net(2, 4, [](double a, double b) { return Eigen::Vector3d(10 * a, 10 * b, 0); });
    const double angle = 30 * degrees;
    const NurbsSurface right = net(2, 4, [&](double a, double b) {
        return Eigen::Vector3d(10 + 8 * a * std::cos(angle), 10 * b, 8 * a * std::sin(angle));
    });
    const auto turned_v = [](const NurbsSurface& s) {
        return patches::exchanged(patches::mirrored_u(patches::exchanged(s)));
    };
    for (const NurbsSurface& a : {left, patches::mirrored_u(left), patches::exchanged(left), turned_v(left)})
        for (const NurbsSurface& b : {right, patches::mirrored_u(right), patches::exchanged(right), turned_v(right)}) {
            const Certificate c = certify(joined({a, b}));
            ASSERT_EQ(c.interfaces.size(), 1u);
            EXPECT_NEAR(c.interfaces[0].greatest_angle, angle, 1e-12);
            EXPECT_NEAR(c.interfaces[0].mean_angle, angle, 1e-12);
            EXPECT_TRUE(c.suited());
        }
}

TEST(Certificate, SaysWhyTheNetsLeak)
{
    const NurbsSurface left = patches::curved(100, false);
    MultiPatch two{{left, patches::beyond(left)}, {{{0, Side::u1}, {1, Side::u0}, false}}};
    EXPECT_TRUE(certify(two).suited());
    two.patch[1].control(2, 0) += 1e-9;
    const Certificate c = certify(two);
    EXPECT_FALSE(c.suited());
    EXPECT_NE(c.leak.find("patch 1"), std::string::npos);
    EXPECT_TRUE(c.interfaces.empty());
    two.patch[1].knots_u.pop_back();
    EXPECT_THROW(certify(two), InputError);
}

TEST(Certificate, OfALargeSurfaceCanBeCancelledAtEveryRowOfSpans)
{
    constexpr int count = 43; // 40 x 40 cubic spans
    const NurbsSurface wavy = net(
        3, count, [](double s, double t) { return Eigen::Vector3d(100 * s, 100 * t, 5 * std::sin(6 * s + 4 * t)); });
    std::vector<double> fractions;
    certify({{wavy}, {}}, Progress([&](double fraction, std::string_view) { fractions.push_back(fraction); }));
    EXPECT_GE(fractions.size(), 2u * 40) << "proving and judging";
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions.front(), 0);
    EXPECT_GT(fractions.back(), 0.98);
    for (size_t stop = 1; stop < fractions.size(); stop += 13) {
        const auto cancel = std::make_shared<std::atomic<bool>>(false);
        size_t seen = 0;
        EXPECT_THROW(
            certify({{wavy}, {}}, Progress([&](double, std::string_view) { *cancel = ++seen == stop; }, cancel)),
            Cancelled)
            << stop;
        EXPECT_EQ(seen, stop);
    }
}

} // namespace
} // namespace spia
