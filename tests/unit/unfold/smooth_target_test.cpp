// Smooth faces as targets: the spline, its fit and the step on it.
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

#include "engine/unfold/step/unfold_step.h"
#include "engine/unfold/target/fit_height.h"
#include "engine/unfold/target/turn_target.h"
#include "tests/support/developable.h"
#include "tests/support/fender.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"

namespace spia::smooth_target_test {
namespace {

using std::numbers::pi;

FlattenOptions steel()
{
    FlattenOptions options;
    options.material = {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, 1.77, 1.77, 1.77, ""};
    options.thickness = 0.8;
    return options;
}

/// Over [-50, 50]^2 of the xy plane: the spline with the coefficients of a polynomial of the second
/// degree is that polynomial.
HeightFace polynomial(double a, double b, double c, double xx, double xy, double yy)
{
    HeightFace face{{0, 0, 0}, Eigen::Matrix<double, 3, 2>::Identity(), {-50, -50}, 10, Eigen::MatrixXd(13, 13)};
    for (int i = 0; i < 13; ++i)
        for (int j = 0; j < 13; ++j) { // Marsden's identity: x^2 has the coefficient x_i^2 - h^2 /
                                       // 3
            const double x = -60 + 10 * i, y = -60 + 10 * j;
            face.coefficient(i, j) = a + b * x + c * y + xx * (x * x - 100. / 3) + xy * x * y + yy * (y * y - 100. / 3);
        }
    return face;
}

struct Flange {
    shapes::DevelopablePart part = shapes::bent_flange({.base = 60, .flange = 30, .triangles = 1500});
    UnfoldPick pick;

    Flange()
    {
        for (int f = 0; f < part.mesh.triangles(); ++f)
            (part.flat.row(0)(part.mesh.triangle.col(f)).mean() < 60 ? pick.fixed : pick.freed).push_back(f);
    }
};

double furthest(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) { return (a - b).colwise().norm().maxCoeff(); }

} // namespace

TEST(HeightFace, IsItsPolynomialInsideAndGoesStraightOnOutside)
{
    const double a = 1, b = 0.1, c = -0.2, xx = 0.003, xy = 0.002, yy = -0.001;
    const TargetSurface face = polynomial(a, b, c, xx, xy, yy);
    const auto value = [&](double x, double y) { return a + b * x + c * y + xx * x * x + xy * x * y + yy * y * y; };
    for (const Eigen::Vector2d& at : {Eigen::Vector2d(3, 4), Eigen::Vector2d(-50, 50), Eigen::Vector2d(49, -31.5)}) {
        const Eigen::Vector3d x = placed(face, at);
        EXPECT_NEAR(x[2], value(at[0], at[1]), 1e-11);
        EXPECT_LT((developed(face, x) - at).norm(), 1e-12);
        const Eigen::Vector3d n(-(b + 2 * xx * at[0] + xy * at[1]), -(c + xy * at[0] + 2 * yy * at[1]), 1);
        EXPECT_LT((outer_normal(face, x) - n.normalized()).norm(), 1e-12);
    }
    const double slope = b + 2 * xx * 50 + xy * 20;
    EXPECT_NEAR(placed(face, {80, 20})[2], value(50, 20) + 30 * slope, 1e-11);
    // The lengths are those of small ways of the face, and the normal is square to them, inside and
    // outside.
    for (const Eigen::Vector2d& at : {Eigen::Vector2d(12, -20), Eigen::Vector2d(70, 10), Eigen::Vector2d(-80, 90)})
        for (const TargetSurface& either : {face, turned_over(face)}) {
            Eigen::Matrix<double, 3, 2> J;
            for (int k = 0; k < 2; ++k)
                J.col(k) = (placed(either, at + 1e-4 * Eigen::Vector2d::Unit(k)) -
                            placed(either, at - 1e-4 * Eigen::Vector2d::Unit(k))) /
                           2e-4;
            const Eigen::Matrix2d M = metric(either, at);
            EXPECT_LT((M * M - J.transpose() * J).norm(), 1e-7);
            EXPECT_LT((J.transpose() * outer_normal(either, placed(either, at))).norm(), 1e-7);
            EXPECT_GT(outer_normal(either, placed(either, at)).dot(J.col(0).cross(J.col(1))), 0);
        }
    EXPECT_LT((placed(turned_over(face), {20, -7}) - placed(face, {-7, 20})).norm(), 1e-12);
}

TEST(FitHeight, GoesThroughASmoothRegionAndOnBesideItWithItsTangent)
{
    TriMesh skin = shapes::rectangle(200, 120, 60, 36); // a skin curved both ways
    const auto height = [](double x, double y) { return 0.001 * (x - 90) * (x - 90) - 0.002 * y * y + 0.0004 * x * y; };
    for (int v = 0; v < skin.vertices(); ++v)
        skin.position(2, v) = height(skin.position(0, v), skin.position(1, v));
    std::vector<int> all(size_t(skin.triangles()));
    for (size_t f = 0; f < all.size(); ++f)
        all[f] = int(f);
    for (const unsigned seed : {0u, 5u}) {
        const Eigen::Matrix3d turn =
            seed ? shapes::random_rotation(seed) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
        const TriMesh there = shapes::transformed(skin, turn, {100, 7, -3});
        EXPECT_FALSE(fit_target(there, all));
        const auto fit = fit_height(there, all);
        ASSERT_TRUE(fit);
        EXPECT_EQ(name(fit->face), "smooth");
        EXPECT_LT(fit->distance_mm, 2e-3);
        EXPECT_LT(fit->angle, 0.02); // a face against its middle
        // Beside its edge it leaves the quadratic by no more than the second order of the way.
        for (const double beyond : {1., 5.}) {
            const Eigen::Vector3d at =
                turn * Eigen::Vector3d(200 + beyond, 60, height(200 + beyond, 60)) + Eigen::Vector3d(100, 7, -3);
            EXPECT_LT((placed(fit->face, developed(fit->face, at)) - at).norm(), 0.002 + 0.0015 * beyond * beyond);
        }
    }
    // A box's corner is none.
    const TriMesh hat = shapes::hat_channel({.triangles = 2000}).mesh;
    std::vector<int> faces(size_t(hat.triangles()));
    for (size_t f = 0; f < faces.size(); ++f)
        faces[f] = int(f);
    EXPECT_FALSE(fit_height(hat, faces));
}

TEST(FitHeight, AcrossAHoleItIsAThinPlate)
{
    // A plate bent by its edges alone is biharmonic; the fourth harmonic has all fourth
    // derivatives, those of x and y together, too.
    TriMesh frame = shapes::plate({.width = 100, .height = 100, .holes = {{{50, 50}, 30}}, .triangles = 6000});
    const auto height = [](double x, double y) {
        x -= 50;
        y -= 50;
        return 2e-6 * (x * x * x * x - 6 * x * x * y * y + y * y * y * y);
    };
    std::vector<int> all;
    for (int f = 0; f < frame.triangles(); ++f)
        all.push_back(f);
    for (int v = 0; v < frame.vertices(); ++v)
        frame.position(2, v) = height(frame.position(0, v), frame.position(1, v));
    const auto fit = fit_height(frame, all);
    ASSERT_TRUE(fit);
    EXPECT_LT(fit->distance_mm, 1e-2);
    for (const Eigen::Vector2d& at : {Eigen::Vector2d(50, 50), Eigen::Vector2d(62, 58), Eigen::Vector2d(40, 65)}) {
        const Eigen::Vector3d x(at[0], at[1], height(at[0], at[1]));
        EXPECT_LT((placed(fit->face, developed(fit->face, x)) - x).norm(), 0.02);
    }
}

TEST(SmoothTarget, OfNoHeightIsThePlaneBitByBitAndOfConstantSlopeThePlaneItIs)
{
    const Flange flange;
    UnfoldPick flat = flange.pick;
    flat.target = PlaneFace{{0, 0, 0}, Eigen::Matrix<double, 3, 2>::Identity()};
    const UnfoldStepResult truth = unfold_step(flange.part.mesh, flange.part.mesh.position, flat, steel());
    UnfoldPick pick = flange.pick;
    pick.target = polynomial(0, 0, 0, 0, 0, 0);
    const UnfoldStepResult level = unfold_step(flange.part.mesh, flange.part.mesh.position, pick, steel());
    EXPECT_TRUE(level.converged());
    EXPECT_LT(furthest(level.position, truth.position), 1e-10);
    // The wall of a cup: strained. The plane z = 0 told as a height over a plane that leans by 50
    // degrees.
    const shapes::AxisymmetricPart cup = shapes::sharp_cup({.triangles = 1500});
    UnfoldPick wall;
    for (int f = 0; f < cup.mesh.triangles(); ++f)
        (cup.mesh.position.row(2)(cup.mesh.triangle.col(f)).cwiseAbs().maxCoeff() < 1e-9 ? wall.fixed : wall.freed)
            .push_back(f);
    const UnfoldStepResult on_plane = unfold_step(cup.mesh, cup.mesh.position, wall, steel());
    const double lean = 50 * pi / 180;
    HeightFace leaning = polynomial(0, -std::tan(lean), 0, 0, 0, 0);
    leaning.axes.col(0) << std::cos(lean), 0, std::sin(lean);
    wall.target = leaning;
    const UnfoldStepResult on_leaning = unfold_step(cup.mesh, cup.mesh.position, wall, steel());
    EXPECT_TRUE(on_leaning.converged()) << on_leaning.piece[0].report.reason;
    EXPECT_LT(furthest(on_leaning.position, on_plane.position), 1e-5);
    EXPECT_LT((on_leaning.face.thickness - on_plane.face.thickness).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(SmoothTarget, ACylinderToldAsAHeightIsTheCylinderToSecondOrder)
{
    // A strip around 0.6 radians of a cylinder, then a flat flange down; both targets are exact
    // where it lands.
    const double radius = 60;
    std::vector<double> h, error;
    for (const int n : {6, 12, 24}) {
        const TriMesh part = shapes::grid_surface({4 * n, n}, [&](double u, double v) {
            const double arc = 60 * u, bend = 40;
            const double angle = (std::min(arc, bend) - bend) / radius;
            Eigen::Vector3d x(radius * std::sin(angle), 20 * v, radius * (std::cos(angle) - 1));
            if (arc > bend)
                x += (arc - bend) * Eigen::Vector3d(std::cos(1.2), 0, -std::sin(1.2));
            return x;
        });
        // Over the xy plane: a dense spline through z = sqrt(r^2 - x^2) - r by its nodal values
        // would do; the fit of a fine strip does.
        const TriMesh fine = shapes::grid_surface({400, 20}, [&](double u, double v) {
            const double angle = -0.7 + 1.15 * u;
            return Eigen::Vector3d(radius * std::sin(angle), -5 + 30 * v, radius * (std::cos(angle) - 1));
        });
        std::vector<int> all(size_t(fine.triangles()));
        for (size_t f = 0; f < all.size(); ++f)
            all[f] = int(f);
        const auto fit = fit_height(fine, all);
        ASSERT_TRUE(fit);
        EXPECT_LT(fit->distance_mm, 2e-3);
        UnfoldPick pick;
        for (int f = 0; f < part.triangles(); ++f)
            (f / 2 % (4 * n) < 8 * n / 3 ? pick.fixed : pick.freed).push_back(f);
        pick.target = CylinderFace{{0, 0, -radius}, {0, 1, 0}, {0, 0, 1}, radius, true};
        const UnfoldStepResult exact = unfold_step(part, part.position, pick, steel());
        pick.target = fit->face;
        const UnfoldStepResult smooth = unfold_step(part, part.position, pick, steel());
        EXPECT_TRUE(smooth.converged()) << smooth.piece[0].report.reason;
        h.push_back(1. / n);
        error.push_back(furthest(exact.position, smooth.position));
    }
    EXPECT_LT(error.back(), 3e-3);
    EXPECT_GT(shapes::convergence_order(h, error), 1.7);
}

TEST(SmoothTarget, WhatIsOnItAlreadyStaysAndWhatWasBentComesBack)
{
    // Both pieces of a skin curved both ways; the outer one turned about the straight line x = 60
    // is a part of which it comes.
    TriMesh skin = shapes::rectangle(80, 50, 40, 25);
    for (int v = 0; v < skin.vertices(); ++v) {
        const double x = skin.position(0, v) - 30, y = skin.position(1, v) - 25;
        skin.position(2, v) = 0.002 * x * x - 0.0025 * y * y;
    }
    UnfoldPick pick;
    std::vector<int> all;
    for (int f = 0; f < skin.triangles(); ++f) {
        (skin.position.row(0)(skin.triangle.col(f)).mean() < 60 ? pick.fixed : pick.freed).push_back(f);
        all.push_back(f);
    }
    const auto fit = fit_height(skin, all);
    ASSERT_TRUE(fit);
    pick.target = fit->face;
    const UnfoldStepResult same = unfold_step(skin, skin.position, pick, steel());
    EXPECT_TRUE(same.converged()) << same.piece[0].report.reason;
    EXPECT_LT(furthest(same.position, skin.position), 0.01);
    EXPECT_LT(same.face.strain_equivalent.maxCoeff(), 2e-3);
    // Without a target one is made of the fixed region; beside it it goes straight on where the
    // skin is curved.
    pick.target.reset();
    const UnfoldStepResult own = unfold_step(skin, skin.position, pick, steel());
    EXPECT_EQ(name(own.target.face), "smooth");
    EXPECT_LT(own.target.distance_mm, 1e-2);
    EXPECT_LT(own.target.angle, 0.05);
    EXPECT_TRUE(own.converged());
    EXPECT_LT(furthest(own.position, skin.position), 0.002 * 20 * 20 * 1.5);
}

TEST(SmoothTarget, TheFlangeOfAFenderGoesOnWithItsSkin)
{
    const shapes::ParametricMesh fender = shapes::fender({.flange_angle_deg = 30, .triangles = 8000});
    constexpr double bend = 240; // where the flange begins, in the parameter plane
    UnfoldPick pick;
    for (int f = 0; f < fender.mesh.triangles(); ++f)
        (fender.parameter.row(1)(fender.mesh.triangle.col(f)).maxCoeff() < bend + 1e-6 ? pick.fixed : pick.freed)
            .push_back(f);
    const UnfoldStepResult result = unfold_step(fender.mesh, fender.mesh.position, pick, steel());
    EXPECT_TRUE(result.converged()) << result.piece[0].report.reason;
    EXPECT_EQ(name(result.target.face), "smooth");
    EXPECT_LT(result.target.distance_mm, 0.1);
    EXPECT_LT(result.target.angle, 0.05);
    EXPECT_LT(result.face.strain_equivalent.maxCoeff(), 0.04);
    // In the middle its edge is as far beyond the bend as the flange is long, down the slope that
    // the skin has there.
    const double length = 5 * 30 * pi / 180 + 18, slope = 240. / 700;
    int edge = 0;
    for (int v = 0; v < fender.mesh.vertices(); ++v)
        if (fender.parameter(1, v) > bend + length - 1e-6 && std::abs(fender.parameter(0, v)) < 150) {
            // the bend is one chord
            EXPECT_NEAR(result.position(1, v), bend + length / std::hypot(1, slope), 0.3);
            ++edge;
        }
    EXPECT_GT(edge, 5);
}

} // namespace spia::smooth_target_test
