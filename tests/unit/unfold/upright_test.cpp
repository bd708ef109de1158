#include "engine/unfold/step/upright.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace spia {
namespace {

using std::numbers::pi;

/// A flat mesh and its places in the plane.
struct Flat {
    TriMesh mesh;
    Eigen::Matrix2Xd place;
};

/// A polygon that is seen whole from a point inside: a fan of triangles around it.
Flat fan(const Eigen::Matrix2Xd& rim, const Eigen::Vector2d& centre)
{
    const auto count = int(rim.cols());
    Flat flat;
    flat.place.resize(2, count + 1);
    flat.place << rim, centre;
    flat.mesh.position = Eigen::Matrix3Xd::Zero(3, count + 1);
    flat.mesh.position.topRows<2>() = flat.place;
    flat.mesh.triangle.resize(3, count);
    for (int k = 0; k < count; ++k)
        flat.mesh.triangle.col(k) << k, (k + 1) % count, count;
    return flat;
}

Flat polygon(std::initializer_list<Eigen::Vector2d> corners, const Eigen::Vector2d& centre)
{
    Eigen::Matrix2Xd rim(2, Eigen::Index(corners.size()));
    Eigen::Index k = 0;
    for (const Eigen::Vector2d& corner : corners)
        rim.col(k++) = corner;
    return fan(rim, centre);
}

Eigen::Matrix2d turn(double angle) { return Eigen::Rotation2Dd(angle).toRotationMatrix(); }

Eigen::Matrix2Xd turned(const Eigen::Matrix2Xd& places, double angle, const Eigen::Vector2d& by = {0, 0})
{
    return (turn(angle) * places).colwise() + by;
}

Eigen::Vector2d box(const Eigen::Matrix2Xd& flat) { return flat.rowwise().maxCoeff() - flat.rowwise().minCoeff(); }

/// The smallest box with a side along an edge, by trying every edge with all places.
double least_area(const Eigen::Matrix2Xd& rim)
{
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < rim.cols(); ++k) {
        const Eigen::Vector2d way = rim.col((k + 1) % rim.cols()) - rim.col(k);
        least = std::min(least, box(turn(-std::atan2(way[1], way[0])) * rim).prod());
    }
    return least;
}

/// Likewise over all directions, in steps.
double least_area_of_all(const Eigen::Matrix2Xd& rim)
{
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 2000; ++k)
        least = std::min(least, box(turn(k * pi / 4000) * rim).prod());
    return least;
}

} // namespace

TEST(Upright, WithoutStraightEdgesHasTheSmallestBox)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> far(30, 60), any(0, 2 * pi);
    for (int trial = 0; trial < 60; ++trial) {
        const int count = 41 + 4 * trial;
        const double start = any(random);
        Eigen::Matrix2Xd rim(2, count);
        for (int k = 0; k < count; ++k) {
            const double angle = start + 2 * pi * k / count, r = trial % 2 ? far(random) : 40;
            rim.col(k) << 7 + r * std::cos(angle), 2 * r * std::sin(angle) - 3;
        }
        const Flat flat = fan(rim, {7, -3});
        const Eigen::Matrix2Xd laid = upright(flat.mesh, flat.place);
        EXPECT_LE(box(laid).prod(), least_area(rim) * (1 + 1e-8)) << trial;
        EXPECT_LE(box(laid).prod(), least_area_of_all(rim) * (1 + 1e-4)) << trial;
        EXPECT_GE(box(laid)[0], box(laid)[1] * (1 - 1e-12)) << trial;
        EXPECT_NEAR(laid.minCoeff(), 0, 1e-12) << trial;
        for (int k = 0; k < count; ++k) // turned, not mirrored or stretched
            EXPECT_NEAR((laid.col(k) - laid.col(0)).norm(), (rim.col(k) - rim.col(0)).norm(), 1e-10);
    }
}

TEST(Upright, TheLongestStraightEdgesLieAlongXAndY)
{
    // A strip with a slanting end and a wide slanting flag: the smallest box lies along the flag.
    const Flat flat = polygon({{0, 0}, {100, 0}, {100, 30}, {60, 30}, {70, 95}, {45, 99}, {34, 30}, {0, 30}}, {50, 25});
    for (const double angle : {0., 0.3, 1.2, 2.9, 4.}) {
        const Eigen::Matrix2Xd laid = upright(flat.mesh, turned(flat.place, angle, {800, -3}));
        EXPECT_NEAR(std::min(std::abs(laid(0, 1) - laid(0, 0)), std::abs(laid(1, 1) - laid(1, 0))), 0, 1e-9) << angle;
    }
}

TEST(Upright, AWavyEdgeOfADrawnBlankCountsAsStraight)
{
    // 200 x 120, the long sides bent outwards by 0.3 mm as after drawing, the corners cut by arcs.
    Eigen::Matrix2Xd rim(2, 120);
    for (int k = 0; k < 120; ++k) {
        const double angle = 2 * pi * (k + 0.25) / 120, c = std::cos(angle), s = std::sin(angle);
        const double p = 16; // a superellipse
        const double r = std::pow(std::pow(std::abs(c), p) + std::pow(std::abs(s), p), -1 / p);
        rim.col(k) << 100 * r * c, 60 * r * s;
    }
    const Flat flat = fan(rim, {0, 0});
    for (const double angle : {0.2, 1., 5.}) {
        const Eigen::Vector2d size = box(upright(flat.mesh, turned(flat.place, angle)));
        EXPECT_NEAR(size[0], 200, 0.05);
        EXPECT_NEAR(size[1], 120, 0.05);
    }
}

TEST(Upright, DoesNotDependOnHowThePartLayOrIsNumbered)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(0, 1);
    for (int trial = 0; trial < 200; ++trial) {
        // Brackets, flags, tapered strips: four to nine corners around the middle, some edges
        // square to each other.
        const int count = 4 + trial % 6;
        Eigen::Matrix2Xd rim(2, count);
        for (int k = 0; k < count; ++k) {
            const double angle = 2 * pi * (k + 0.6 * any(random)) / count, r = 20 + 60 * any(random);
            rim.col(k) << 1.5 * r * std::cos(angle), r * std::sin(angle);
        }
        const Flat flat = fan(rim, {0, 0});
        const Eigen::Matrix2Xd wanted = upright(flat.mesh, flat.place);
        const double angle = 2 * pi * any(random);
        EXPECT_LT((upright(flat.mesh, turned(flat.place, angle, {3, 900})) - wanted).norm(), 1e-8) << trial;
        // Numbered anew.
        std::vector<int> number(size_t(count) + 1);
        std::iota(number.begin(), number.end(), 0);
        std::shuffle(number.begin(), number.end(), random);
        Flat other = flat;
        for (int v = 0; v <= count; ++v)
            other.place.col(number[size_t(v)]) = turned(flat.place, -angle).col(v);
        for (int f = 0; f < count; ++f)
            for (int k = 0; k < 3; ++k)
                other.mesh.triangle((k + f) % 3, count - 1 - f) = number[size_t(flat.mesh.triangle(k, f))];
        other.mesh.position.topRows<2>() = other.place;
        EXPECT_LT((upright(other.mesh, other.place)(Eigen::all, number) - wanted).norm(), 1e-8) << trial;
    }
}

TEST(Upright, TheHeavyEndLiesBelowThenLeft)
{
    // Narrower above, shifted to the right: below is the wide side.
    const Flat flat = polygon({{0, 0}, {100, 0}, {90, 40}, {40, 40}}, {55, 20});
    for (const double angle : {0., 1., 3.1, 4.5}) {
        const Eigen::Matrix2Xd laid = upright(flat.mesh, turned(flat.place, angle));
        EXPECT_NEAR(laid(1, 0), 0, 1e-9) << angle;
        EXPECT_NEAR(laid(1, 1), 0, 1e-9) << angle;
    }
    // An arrow along x, heavy at one end: that is left.
    const Flat arrow =
        polygon({{0, -25}, {30, -25}, {30, -10}, {100, -10}, {100, 10}, {30, 10}, {30, 25}, {0, 25}}, {20, 0});
    for (const double angle : {0., 1., 3.1, 4.5})
        EXPECT_LT(upright(arrow.mesh, turned(arrow.place, angle))(0, 0), 1e-9) << angle;
}

TEST(Upright, TheRollingDirectionOverrides)
{
    const Flat flat = polygon({{0, 0}, {100, 0}, {100, 30}, {0, 30}}, {50, 15});
    for (const double angle : {0., 0.3, 2.})
        for (const double rolled : {0.2, 1.3, 3.}) {
            const Eigen::Vector2d rolling = 5 * turn(angle) * Eigen::Vector2d(std::cos(rolled), std::sin(rolled));
            const Eigen::Matrix2Xd laid = upright(flat.mesh, turned(flat.place, angle), rolling);
            const Eigen::Vector2d edge = laid.col(1) - laid.col(0);
            const double off = std::remainder(std::atan2(edge[1], edge[0]) + rolled, pi);
            EXPECT_NEAR(off, 0, 1e-9) << "the edge lies at the angle to x that it has to the rolling direction";
        }
}

} // namespace spia
