#include "engine/forming/flatten.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>
#include <oneapi/tbb/global_control.h>

#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "tests/support/developable.h"
#include "tests/support/grid_surface.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"
#include "tests/support/shapes.h"
#include "tests/support/square_cup.h"

namespace spia::flatten_test {
namespace {

FlattenOptions mild_steel(double r = 1.77)
{
    FlattenOptions options;
    options.material = {"mild", 206000, 0.3, 7850, Swift{565.32, 0.007117, 0.2589}, r, r, r, ""};
    options.thickness = 0.78;
    return options;
}

double largest_strain(const SheetFields& fields)
{
    return std::max(fields.strain_major.cwiseAbs().maxCoeff(), fields.strain_minor.cwiseAbs().maxCoeff());
}

/// Largest distance between two layouts after the best rigid motion in the plane.
double distance(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b)
{
    const Eigen::Matrix2Xd x = a.colwise() - a.rowwise().mean(), y = b.colwise() - b.rowwise().mean();
    const Eigen::Matrix2d moment = y * x.transpose();
    const double angle = std::atan2(moment(1, 0) - moment(0, 1), moment(0, 0) + moment(1, 1));
    return (Eigen::Rotation2Dd(angle).toRotationMatrix() * x - y).colwise().norm().maxCoeff();
}

} // namespace

TEST(Flatten, DevelopablePartsUnrollWithoutStrainInAnyOrientation)
{
    const std::vector<std::pair<const char*, shapes::DevelopablePart>> parts = {
        {"quarter cylinder", shapes::quarter_cylinder({.triangles = 2000})},
        {"cone sector", shapes::cone_sector({.triangles = 3000})},
        {"hat channel", shapes::hat_channel({.triangles = 4000})},
        {"lipped channel", shapes::lipped_channel({.triangles = 6000})},
    };
    unsigned seed = 1;
    for (const auto& [name, part] : parts)
        for (int turn = 0; turn < 3; ++turn) {
            const TriMesh turned = shapes::transformed(
                part.mesh, turn == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : shapes::random_rotation(seed++),
                Eigen::Vector3d(100, -40, 7));
            const FlattenResult result = flatten(turned, mild_steel());
            EXPECT_TRUE(result.report.converged) << name << ": " << result.report.reason;
            EXPECT_LT(largest_strain(result.face), 1e-8) << name;
            // mm: strain times length, summed
            EXPECT_LT(distance(result.blank.position, part.flat), 1e-5) << name;
        }
}

TEST(Flatten, SharpCupKeepsItsBottomAndMeetsTheClosedForm)
{
    // R0 = rw [1 + (1+m) H / rw]^(1/(1+m)), m = r/(1+r); rim thickness ratio (R0 / rw)^(1/(1+r)).
    const double r = 1.77, m = r / (1 + r);
    std::vector<double> h, error, rim_error;
    for (int triangles : {5000, 20000, 80000}) {
        shapes::SharpCup shape;
        shape.triangles = triangles;
        const shapes::AxisymmetricPart cup = shapes::sharp_cup(shape);
        const double R0 = shape.radius * std::pow(1 + (1 + m) * shape.height / shape.radius, 1 / (1 + m));
        const FlattenResult result = flatten(cup.mesh, mild_steel(r));
        ASSERT_TRUE(result.report.converged) << result.report.reason;
        const Eigen::Vector2d pole = result.blank.position.col(0);
        double radius = 0, thickness = 0;
        for (int v : cup.rim) {
            radius += (result.blank.position.col(v) - pole).norm() / double(cup.rim.size());
            thickness += result.node.thickness[v] / double(cup.rim.size());
        }
        double bottom = 0; // largest strain well inside the bottom
        for (int v = 0; v < cup.mesh.vertices(); ++v)
            if (cup.arc_length[v] < 0.8 * shape.radius)
                bottom = std::max(bottom, result.node.strain_equivalent[v]);
        h.push_back(shapes::mean_edge(cup.mesh));
        error.push_back(std::abs(radius / R0 - 1));
        rim_error.push_back(std::abs(thickness / 0.78 / std::pow(R0 / shape.radius, 1 / (1 + r)) - 1));
        std::printf("sharp cup %d: R0 %.2e rim %.2e bottom %.2e\n", triangles, error.back(), rim_error.back(), bottom);
        EXPECT_LT(bottom, 2e-3); // the sheet's yield strain is 8e-4
    }
    EXPECT_LT(error.back(), 1e-4);
    EXPECT_LT(rim_error.back(), 2e-4);
    EXPECT_GT(shapes::convergence_order(h, error), 1.5);
}

TEST(Flatten, DeepSquareCupHasTheSameOutlineOnTwoMeshes)
{
    const auto outline = [](int triangles) {
        shapes::SquareCup shape;
        shape.triangles = triangles;
        const TriMesh cup = shapes::square_cup(shape);
        const FlattenResult result = flatten(cup, mild_steel());
        EXPECT_TRUE(result.report.converged) << triangles << ": " << result.report.reason;
        EXPECT_EQ(result.flipped_triangles, 0);
        std::printf("square cup %d: E %zu N %zu %.2f s necking %d thinning %.3f\n", cup.triangles(),
                    result.report.energy.size(), result.report.newton.size(), result.report.seconds,
                    result.necking_triangles, result.face.thinning.maxCoeff());
        // Radius of the outline over the direction, from the centre of the outline.
        const auto loop = boundary_loops(cup).front();
        Eigen::Matrix2Xd at(2, Eigen::Index(loop.size()));
        for (size_t i = 0; i < loop.size(); ++i)
            at.col(Eigen::Index(i)) = result.blank.position.col(loop[i]);
        const Eigen::Vector2d centre = 0.5 * (at.rowwise().maxCoeff() + at.rowwise().minCoeff());
        std::vector<double> radius;
        for (int k = 0; k < 360; ++k) {
            const double angle = k * std::numbers::pi / 180;
            const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
            for (Eigen::Index i = 0; i < at.cols(); ++i) {
                const Eigen::Vector2d a = at.col(i) - centre, b = at.col((i + 1) % at.cols()) - centre;
                const double ca = ray[0] * a[1] - ray[1] * a[0], cb = ray[0] * b[1] - ray[1] * b[0];
                if (ca <= 0 && cb > 0 && (a.dot(ray) > 0 || b.dot(ray) > 0)) {
                    const double t = ca / (ca - cb);
                    radius.push_back((a + t * (b - a)).dot(ray));
                    break;
                }
            }
        }
        EXPECT_EQ(radius.size(), 360u);
        return radius;
    };
    const auto coarse = outline(20000), fine = outline(100000);
    double largest = 0;
    for (size_t k = 0; k < std::min(coarse.size(), fine.size()); ++k)
        largest = std::max(largest, std::abs(coarse[k] / fine[k] - 1));
    std::printf("square cup: outlines differ by %.2e\n", largest);
    EXPECT_LT(largest, 0.003);
}

TEST(Flatten, RigidMotionScaleMirrorAndPermutationChangeNothing)
{
    const TriMesh part = shapes::square_cup({.depth = 20, .draft_deg = 10, .triangles = 3000});
    const FlattenOptions options = mild_steel();
    const FlattenResult reference = flatten(part, options);
    ASSERT_TRUE(reference.report.converged);
    EXPECT_EQ(reference.report.system, SolvedSystem::strict);
    EXPECT_GT(reference.volume_error, 0); // rounding
    EXPECT_LT(reference.volume_error, 1e-12);
    constexpr double close = 1e-6; // mm: the solver's tolerance, not rounding

    const FlattenResult moved =
        flatten(shapes::transformed(part, shapes::random_rotation(5), Eigen::Vector3d(1000, 2, -300)), options);
    EXPECT_LT(distance(moved.blank.position, reference.blank.position), close);

    const FlattenResult far = // its own coordinates have 9 digits behind the point
        flatten(shapes::transformed(part, Eigen::Matrix3d::Identity(), Eigen::Vector3d(1e7, -1e7, 1e7)), options);
    EXPECT_TRUE(far.report.reason == "converged") << far.report.reason;
    EXPECT_LT((far.face.thinning - reference.face.thinning).cwiseAbs().maxCoeff(), 1e-7);
    const auto middle = [](const FlattenResult& flat) -> Eigen::Vector2d {
        return flat.blank.position.rowwise().mean();
    };
    // still under the part
    EXPECT_LT((middle(far) - middle(reference) - Eigen::Vector2d(1e7, -1e7)).norm(), 1e-4);

    FlattenOptions thick = options;
    thick.thickness *= 25.4;
    const FlattenResult scaled = flatten(shapes::scaled(part, 25.4), thick);
    EXPECT_LT(distance(scaled.blank.position / 25.4, reference.blank.position), close);
    EXPECT_LT((scaled.face.thinning - reference.face.thinning).cwiseAbs().maxCoeff(), 1e-7);

    const FlattenResult mirrored = flatten(shapes::mirrored(part), options);
    Eigen::Matrix2Xd back = mirrored.blank.position;
    back.row(0) *= -1;
    EXPECT_LT(distance(back, reference.blank.position), close);

    const shapes::Permuted permuted = shapes::permuted(part, 11);
    const FlattenResult shuffled = flatten(permuted.mesh, options);
    Eigen::Matrix2Xd restored(2, part.vertices());
    for (int v = 0; v < part.vertices(); ++v)
        restored.col(v) = shuffled.blank.position.col(permuted.vertex[size_t(v)]);
    EXPECT_LT(distance(restored, reference.blank.position), close);
}

TEST(Flatten, GivesTheSameBitsOnOneThreadAndOnTwo)
{
    const TriMesh part = shapes::square_cup({.triangles = 4000});
    const auto run = [&](size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return flatten(part, mild_steel()).blank.position;
    };
    const Eigen::Matrix2Xd one = run(1), two = run(2);
    EXPECT_TRUE((one.array() == two.array()).all());
}

TEST(Flatten, RefusesWhatCannotBeUnfolded)
{
    const TriMesh flat = shapes::rectangle(10, 10, 2, 2);
    FlattenOptions options = mild_steel();
    options.thickness = 0;
    EXPECT_THROW(flatten(flat, options), InputError);
    TriMesh needle = flat;
    needle.position.col(4) = needle.position.col(0); // the middle vertex onto a corner: two faces
                                                     // lose their area
    EXPECT_THROW(flatten(needle, mild_steel()), InputError);
    TriMesh tetrahedron;
    tetrahedron.position = Eigen::Matrix<double, 3, 4>{{0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    tetrahedron.triangle = Eigen::Matrix<int, 3, 4>{{0, 0, 0, 1}, {2, 1, 3, 2}, {1, 3, 2, 3}};
    EXPECT_THROW(flatten(tetrahedron, mild_steel()), InputError);
    EXPECT_THROW(flatten(shapes::two_rectangles(), mild_steel()), InputError);
    TriMesh handle = shapes::torus(60, 20, 400);
    handle.triangle.conservativeResize(3, handle.triangles() - 1);
    EXPECT_THROW(flatten(handle, mild_steel()), InputError);
}

TEST(Flatten, SaysWhereTheBlankLiesOnItself)
{
    // A staircase of one and a half turns is a ring of that angle when it is flat: its ends lie on
    // each other.
    const auto stair = [](double turns) {
        return shapes::grid_surface({int(60 * turns), 4}, [=](double u, double v) -> Eigen::Vector3d {
            const double angle = 2 * std::numbers::pi * turns * u, r = 40 + 20 * v;
            return {r * std::cos(angle), r * std::sin(angle), 4 * turns * u};
        });
    };
    const FlattenResult half = flatten(stair(0.5), mild_steel()), more = flatten(stair(1.5), mild_steel());
    EXPECT_TRUE(half.overlap.none());
    EXPECT_FALSE(more.overlap.crossings.empty());
    EXPECT_TRUE(more.overlap.wound.empty());
    EXPECT_EQ(more.flipped_triangles, 0);
}

TEST(Flatten, ShowsTheBlankWhileItConverges)
{
    const TriMesh part = shapes::square_cup({.triangles = 2000});
    std::vector<double> seen;
    Eigen::Matrix2Xd last;
    const auto watch = [&](const Eigen::Matrix2Xd& blank, const NewtonStep& step) {
        EXPECT_EQ(flipped_triangles(part.triangle, blank), 0);
        seen.push_back(step.residual);
        last = blank;
    };
    const FlattenResult result = flatten(part, mild_steel(), {}, watch);
    ASSERT_EQ(seen.size(), result.report.energy.size() + result.report.newton.size());
    EXPECT_EQ(seen.back(), result.report.residual);
    EXPECT_LT(distance(last, result.blank.position), 1e-9);
}

TEST(Flatten, CancellingStopsAtTheNextStep)
{
    int steps = 0;
    auto cancel = std::make_shared<std::atomic<bool>>(false);
    const Progress progress(
        [&](double, std::string_view) {
            if (++steps == 5)
                *cancel = true;
        },
        cancel);
    EXPECT_THROW(flatten(shapes::square_cup({.triangles = 2000}), mild_steel(), progress), Cancelled);
    EXPECT_EQ(steps, 5);
}

} // namespace spia::flatten_test
