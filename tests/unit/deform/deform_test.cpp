#include "engine/deform/deform.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "engine/core/error.h"
#include "engine/nurbs/certificate.h"
#include "engine/nurbs/evaluate.h"
#include "tests/support/joined_patches.h"

namespace spia {
namespace {

/// A lattice in a slanted frame with some displacements.
Lattice slanted(std::array<int, 3> count, std::array<int, 3> degree)
{
    Lattice lattice;
    lattice.origin = {-3, 4, 1};
    lattice.edge << 20, 2, 1, -3, 15, 2, 0, 1, 12;
    lattice.count = count;
    lattice.degree = degree;
    lattice.move.resize(3, lattice.points());
    for (int p = 0; p < lattice.points(); ++p)
        lattice.move.col(p) << std::sin(3.1 * p), std::cos(1.7 * p), std::sin(0.9 * p + 1);
    return lattice;
}

/// [Sederberg & Parry 1986, eq. 2], by factorials.
Eigen::Vector3d bernstein_sum(const Lattice& lattice, const Eigen::Vector3d& t)
{
    const auto bernstein = [](int n, int i, double x) {
        return std::tgamma(n + 1) / (std::tgamma(i + 1) * std::tgamma(n - i + 1)) * std::pow(x, i) *
               std::pow(1 - x, n - i);
    };
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = 0; k < lattice.count[2]; ++k)
        for (int j = 0; j < lattice.count[1]; ++j)
            for (int i = 0; i < lattice.count[0]; ++i)
                sum += bernstein(lattice.count[0] - 1, i, t[0]) * bernstein(lattice.count[1] - 1, j, t[1]) *
                       bernstein(lattice.count[2] - 1, k, t[2]) * lattice.move.col(lattice.index(i, j, k));
    return sum;
}

/// Moves every lattice point as an affine map moves its place at rest.
void move_affinely(Lattice& lattice, const Eigen::Matrix3d& linear, const Eigen::Vector3d& shift)
{
    const Eigen::Matrix3Xd rest = rest_positions(lattice);
    lattice.move = (linear * rest).colwise() + shift - rest;
}

std::string refusal(const MultiPatch& surface, const Deformation& deformation)
{
    try {
        deform(surface, deformation);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(Lattice, OfDegreeOneLessThanItsPointsIsTheBernsteinSum)
{
    const Lattice lattice = slanted({4, 3, 6}, {3, 2, 5});
    const LatticeMap map(lattice);
    for (int n = 0; n < 60; ++n) {
        const Eigen::Vector3d t(0.5 + 0.5 * std::sin(n), 0.5 + 0.5 * std::cos(2. * n), (n % 7) / 6.);
        EXPECT_LT((map.displacement(lattice.origin + lattice.edge * t) - bernstein_sum(lattice, t)).norm(), 1e-12);
    }
}

TEST(Lattice, OfLowerDegreeMovesOnlyWhatIsNear)
{
    Lattice lattice = slanted({9, 9, 9}, {2, 2, 2}); // 7 spans along each edge
    lattice.move.setZero();
    lattice.move.col(lattice.index(4, 4, 4)) << 0, 0, 1;
    const LatticeMap map(lattice);
    const auto at = [&](double s, double t, double u) {
        return map.displacement(lattice.origin + lattice.edge * Eigen::Vector3d(s, t, u));
    };
    // the middle of a quadratic B-spline is 3/4
    EXPECT_NEAR(at(0.5, 0.5, 0.5)[2], std::pow(0.75, 3), 1e-12);
    EXPECT_EQ(at(0.2, 0.5, 0.5), Eigen::Vector3d(0, 0, 0));
    EXPECT_EQ(at(0.5, 0.5, 0.9), Eigen::Vector3d(0, 0, 0));
}

TEST(Lattice, BeyondTheBoxMovesAsItsNearestPlace)
{
    const Lattice lattice = slanted({4, 4, 4}, {3, 3, 3});
    const LatticeMap map(lattice);
    EXPECT_LT((map.displacement(lattice.origin + lattice.edge * Eigen::Vector3d(0.3, 0.4, 9)) -
               map.displacement(lattice.origin + lattice.edge * Eigen::Vector3d(0.3, 0.4, 1)))
                  .norm(),
              1e-12);
}

TEST(Deform, AnAffineLatticeMovesTheSurfaceAffinely)
{
    Eigen::Matrix3d linear;
    linear << 1.1, 0.2, -0.1, 0.05, 0.9, 0.3, -0.2, 0.1, 1.2;
    const Eigen::Vector3d shift(3, -7, 2);
    for (const patches::Sample& sample : patches::samples())
        for (const std::array<int, 3> degree : {std::array{1, 1, 1}, std::array{3, 2, 4}}) {
            Deformation deformation;
            deformation.lattice = lattice_around(sample.patches, {6, 3, 5}, degree);
            move_affinely(*deformation.lattice, linear, shift);
            const DeformResult result = deform(sample.patches, deformation);
            for (size_t p = 0; p < sample.patches.patch.size(); ++p)
                for (int n = 0; n < 25; ++n) {
                    const double u = n % 5 / 4., v = n / 5 / 4.;
                    const Eigen::Vector3d before = evaluate(sample.patches.patch[p], u, v).position;
                    const Eigen::Vector3d after = evaluate(result.patches.patch[p], u, v).position;
                    EXPECT_LT((after - (linear * before + shift)).norm(), 1e-11) << sample.name;
                }
            EXPECT_LT(result.off_lattice, 1e-11)
                << sample.name << ": weights stay, so rational patches are moved exactly, too";
        }
}

TEST(Deform, AtRestChangesNoBit)
{
    for (const patches::Sample& sample : patches::samples()) {
        Deformation deformation;
        deformation.lattice = lattice_around(sample.patches, {4, 4, 4});
        deformation.moves = {{0, 1, 1, {0, 0, 0}}};
        EXPECT_TRUE(deformation.at_rest());
        const DeformResult result = deform(sample.patches, deformation);
        EXPECT_EQ(result.largest, 0);
        for (size_t p = 0; p < sample.patches.patch.size(); ++p)
            EXPECT_EQ(result.patches.patch[p].control, sample.patches.patch[p].control);
    }
}

TEST(Deform, KeepsPatchesJoinedBitForBit)
{
    for (const patches::Sample& sample : patches::samples()) {
        Deformation deformation;
        deformation.lattice = lattice_around(sample.patches, {5, 4, 3});
        for (Eigen::Index p = 0; p < deformation.lattice->move.cols(); ++p)
            deformation.lattice->move.col(p) =
                2 * Eigen::Vector3d(std::sin(2. * double(p)), std::cos(3. * double(p)), 0.4);
        // corners, which several share, by one of them
        for (size_t p = 0; p < sample.patches.patch.size(); ++p)
            if (p == 0)
                for (const int j : {0, sample.patches.patch[p].count_v - 1})
                    deformation.moves.push_back({int(p), sample.patches.patch[p].count_u - 1, j, {1, 2, 0.3 + j}});
        const DeformResult result = deform(sample.patches, deformation);
        EXPECT_NO_THROW(require_watertight(result.patches)) << sample.name;
        EXPECT_EQ(result.patches.interfaces, sample.patches.interfaces);
        EXPECT_GT(result.largest, 1);
    }
}

TEST(Deform, BendsAPlateToAnArc)
{
    // A flat strip 100 long; a lattice whose points are put on the arc moves it near there, the
    // nearer the more points.
    NurbsSurface strip;
    strip.degree_u = 3, strip.degree_v = 1;
    strip.count_u = 23, strip.count_v = 2;
    strip.knots_u = {0, 0, 0, 0};
    for (int i = 1; i < 20; ++i)
        strip.knots_u.push_back(i / 20.);
    strip.knots_u.insert(strip.knots_u.end(), {1, 1, 1, 1});
    strip.knots_v = {0, 0, 1, 1};
    strip.control.resize(3, 46);
    strip.weight = Eigen::VectorXd::Ones(46);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 23; ++i) {
            double greville = 0;
            for (int k = 1; k <= 3; ++k)
                greville += strip.knots_u[size_t(i + k)] / 3;
            strip.control.col(strip.index(i, j)) << 100 * greville, 10 * j, 0;
        }
    const double radius = 80;
    double last = 0;
    for (const int points : {5, 9, 17, 33}) {
        Deformation deformation;
        Lattice& lattice = deformation.lattice.emplace();
        lattice.origin = {0, 0, -5};
        lattice.edge = Eigen::Vector3d(100, 10, 10).asDiagonal();
        lattice.count = {points, 2, 2};
        lattice.degree = {3, 1, 1};
        lattice.move.resize(3, lattice.points());
        const Eigen::Matrix3Xd rest = rest_positions(lattice);
        for (int p = 0; p < lattice.points(); ++p) {
            const double angle = rest(0, p) / radius, r = radius - rest(2, p);
            lattice.move.col(p) =
                Eigen::Vector3d(r * std::sin(angle), rest(1, p), radius - r * std::cos(angle)) - rest.col(p);
        }
        const DeformResult result = deform({{strip}, {}}, deformation);
        double worst = 0;
        for (int n = 0; n <= 100; ++n) {
            const Eigen::Vector3d place = evaluate(result.patches.patch[0], n / 100., 0.3).position;
            worst = std::max(worst, std::abs(std::hypot(place.x(), place.z() - radius) - radius));
        }
        EXPECT_LT(result.off_lattice, 0.1);
        if (last > 0 && points < 33) { // a spline of its control points' places: second order, till
                                       // the strip's own net limits it
            EXPECT_NEAR(last / worst, 4, 1.6);
        }
        last = worst;
    }
    EXPECT_LT(last, 0.1);
}

TEST(Deform, SaysWhatCannotBe)
{
    const MultiPatch two = patches::samples()[1].patches; // two that share a side
    ASSERT_EQ(two.patch.size(), 2u);
    const int i = two.patch[0].count_u, j = two.patch[0].count_v;
    EXPECT_NE(refusal(two, {{{2, 0, 0, {1, 0, 0}}}, {}}).find("patch 3, but the surface has 2"), std::string::npos);
    EXPECT_NE(refusal(two, {{{0, i, 0, {1, 0, 0}}}, {}}).find("control point"), std::string::npos);
    EXPECT_NE(refusal(two, {{{0, 0, -1, {1, 0, 0}}}, {}}).find("control point"), std::string::npos);
    EXPECT_NE(refusal(two, {{{0, 0, j - 1, {1, 0, 0}}, {0, 0, j - 1, {0, 1, 0}}}, {}}).find("same control point"),
              std::string::npos);
    EXPECT_NE(refusal(two, {{{0, 0, 0, {NAN, 0, 0}}}, {}}).find("finite"), std::string::npos);
    const PatchInterface joint = two.interfaces.at(0); // by the one patch and by the other
    const int first = side_controls(two.patch[size_t(joint.first.patch)], joint.first.side)[1];
    const std::vector<int> others = side_controls(two.patch[size_t(joint.second.patch)], joint.second.side);
    const int second = joint.reversed ? others[others.size() - 2] : others[1];
    const auto move = [&](int patch, int control) {
        const int count = two.patch[size_t(patch)].count_u;
        return ControlMove{patch, control % count, control / count, {0, 0, 1}};
    };
    EXPECT_NE(
        refusal(two, {{move(joint.first.patch, first), move(joint.second.patch, second)}, {}}).find("same control"),
        std::string::npos);

    Deformation lattice{{}, lattice_around(two, {3, 3, 3})};
    lattice.lattice->move.conservativeResize(3, 26);
    EXPECT_NE(refusal(two, lattice).find("needs 27 displacements, not 26"), std::string::npos);
    lattice.lattice = lattice_around(two, {3, 3, 3});
    lattice.lattice->edge.col(2) = lattice.lattice->edge.col(0) + lattice.lattice->edge.col(1);
    EXPECT_NE(refusal(two, lattice).find("no volume"), std::string::npos);
    EXPECT_THROW(lattice_around(two, {1, 3, 3}), InputError);
    EXPECT_THROW(lattice_around(two, {3, 3, 65}), InputError);
    EXPECT_THROW(lattice_around({}, {3, 3, 3}), InputError);
}

} // namespace spia
