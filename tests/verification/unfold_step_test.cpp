// Local unfolding against closed forms and an independent solution along the meridian.
#include "engine/unfold/step/unfold_step.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <oneapi/tbb/global_control.h>

#include "tests/support/held_flange.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/revolved.h"

namespace spia::unfold_step_test {
namespace {

using std::numbers::pi;

const Swift swift{565.32, 0.007117, 0.2589};

FlattenOptions steel(double r)
{
    FlattenOptions options;
    options.material = {"mild", 206000, 0.3, 7850, swift, r, r, r, ""};
    options.thickness = 0.8;
    return options;
}

/// Fixed: the faces in the plane z = 0.
UnfoldPick all_onto_the_plane(const TriMesh& part)
{
    UnfoldPick pick;
    for (int f = 0; f < part.triangles(); ++f)
        (part.position.row(2)(part.triangle.col(f)).cwiseAbs().maxCoeff() < 1e-9 ? pick.fixed : pick.freed)
            .push_back(f);
    return pick;
}

double mean_radius(const Eigen::Matrix3Xd& position, const std::vector<int>& ring)
{
    double sum = 0;
    for (const int v : ring)
        sum += position.col(v).head<2>().norm() / double(ring.size());
    return sum;
}

/// The innermost ring of vertices.
std::vector<int> inner_edge(const shapes::AxisymmetricPart& part)
{
    std::vector<int> ring;
    for (int v = 0; v < part.mesh.vertices(); ++v)
        if (part.arc_length[v] < 1e-9)
            ring.push_back(v);
    return ring;
}

} // namespace

TEST(UnfoldStep, TheWallOfASharpCupConvergesToItsClosedForm)
{
    const double r = 1.77, m = r / (1 + r);
    for (const double height : {30., 60.}) {
        std::vector<double> h, error;
        for (const int triangles : {5000, 20000, 80000}) {
            const shapes::SharpCup shape{.height = height, .triangles = triangles};
            const shapes::AxisymmetricPart cup = shapes::sharp_cup(shape);
            const UnfoldStepResult result =
                unfold_step(cup.mesh, cup.mesh.position, all_onto_the_plane(cup.mesh), steel(r));
            ASSERT_TRUE(result.converged()) << result.piece[0].report.reason;
            const double R0 = shape.radius * std::pow(1 + (1 + m) * height / shape.radius, 1 / (1 + m));
            h.push_back(shapes::mean_edge(cup.mesh));
            error.push_back(std::abs(mean_radius(result.position, cup.rim) / R0 - 1));
            std::printf("cup %g mm, %d triangles: R0 %.2e, %s, %zu + %zu steps, %.2f s\n", height, triangles,
                        error.back(), std::string(name(result.piece[0].report.system)).c_str(),
                        result.piece[0].report.energy.size(), result.piece[0].report.newton.size(), result.seconds);
        }
        EXPECT_LT(error.back(), 2e-4);
        EXPECT_GT(shapes::convergence_order(h, error), 1.5);
    }
}

TEST(UnfoldStep, TheCollarOfAHoleConvergesToItsClosedForm)
{
    const double r = 1.77, m = r / (1 + r), radius = 40, height = 12;
    std::vector<double> h, error;
    for (const int triangles : {4000, 16000, 64000}) {
        Eigen::Matrix2Xd meridian(2, 3);
        meridian << radius, radius, 70, /**/ -height, 0, 0;
        const shapes::AxisymmetricPart part = shapes::axisymmetric(meridian, triangles);
        const UnfoldStepResult result =
            unfold_step(part.mesh, part.mesh.position, all_onto_the_plane(part.mesh), steel(r));
        ASSERT_TRUE(result.converged()) << result.piece[0].report.reason;
        const double R = radius * std::pow(1 - (1 + m) * height / radius, 1 / (1 + m));
        h.push_back(shapes::mean_edge(part.mesh));
        error.push_back(std::abs(mean_radius(result.position, inner_edge(part)) / R - 1));
        std::printf("collar, %d triangles: %.2e\n", triangles, error.back());
    }
    EXPECT_LT(error.back(), 5e-4); // the edge was stretched by 41 %
    EXPECT_GT(shapes::convergence_order(h, error), 1.5);
}

TEST(UnfoldStep, AStretchFlangeOverARadiusConvergesToTheSolutionAlongItsMeridian)
{
    const double r = 1.77, hole = 60, bend = 8;
    std::vector<double> h, error, thickness_error;
    for (const int triangles : {4000, 16000, 64000}) {
        const auto meridian_from = [&](double held) {
            return shapes::Profile({held, 0}, pi).straight(held - hole).bend(bend, pi / 3).straight(10);
        };
        const shapes::Profile whole = meridian_from(90);
        Eigen::Matrix2Xd points(2, 2001);
        for (int k = 0; k <= 2000; ++k)
            points.col(k) = whole.at(whole.length() * (1 - k / 2000.));
        for (int k = 0; k <= 2000; ++k)
            if (points(0, k) >= hole - 1e-9)
                points(1, k) = 0;
        const shapes::AxisymmetricPart part = shapes::axisymmetric(points, triangles);
        const UnfoldPick pick = all_onto_the_plane(part.mesh);
        const UnfoldStepResult result = unfold_step(part.mesh, part.mesh.position, pick, steel(r));
        ASSERT_TRUE(result.converged()) << result.piece[0].report.reason;
        double held = 90; // the ring where the fixed faces end
        for (const int f : pick.fixed)
            for (const int v : part.mesh.triangle.col(f))
                held = std::min(held, part.mesh.position.col(v).head<2>().norm());
        const shapes::FlangeBlank truth = shapes::held_flange_blank({meridian_from(held), swift, 206000, r, 0.8});
        const std::vector<int> edge = inner_edge(part);
        double thickness = 0, count = 0;
        for (size_t k = 0; k < result.freed.size(); ++k)
            for (const int v : part.mesh.triangle.col(result.freed[k]))
                if (part.arc_length[v] < 1e-9) {
                    thickness += result.face.thickness[Eigen::Index(k)];
                    ++count;
                }
        h.push_back(shapes::mean_edge(part.mesh));
        error.push_back(std::abs(mean_radius(result.position, edge) / truth.R.tail(1)[0] - 1));
        thickness_error.push_back(std::abs(thickness / count / truth.thickness.tail(1)[0] - 1));
        std::printf("stretch flange, %d triangles: edge %.4f (%.2e), thickness %.4f (%.2e)\n", triangles,
                    truth.R.tail(1)[0], error.back(), truth.thickness.tail(1)[0], thickness_error.back());
    }
    EXPECT_LT(error.back(), 2e-4);
    EXPECT_LT(thickness_error.back(), 5e-4); // of the faces at the edge
    EXPECT_GT(shapes::convergence_order(h, error), 1.5);
}

TEST(UnfoldStep, TheWallAroundACrownedBottomConvergesToTheSolutionAlongItsMeridian)
{
    // The bottom is a paraboloid, and so is the target: as a height it is exactly a spline.
    // z = -crown R^2: a slope of 44 degrees at the edge
    const double r = 1.77, radius = 40, height = 20, crown = 0.012;
    HeightFace paraboloid{
        {0, 0, 0}, Eigen::Matrix<double, 3, 2>::Identity(), {-100, -100}, 10, Eigen::MatrixXd(23, 23)};
    for (int i = 0; i < 23; ++i)
        for (int j = 0; j < 23; ++j) {
            const double x = -110 + 10 * i, y = -110 + 10 * j;
            paraboloid.coefficient(i, j) = -crown * (x * x + y * y - 200. / 3);
        }
    const double edge = -crown * radius * radius;
    std::vector<double> h, error;
    for (const int triangles : {3000, 12000, 48000}) {
        Eigen::Matrix2Xd meridian(2, 1002);
        for (int k = 0; k <= 1000; ++k)
            meridian.col(k) << radius * k / 1000, -crown * std::pow(radius * k / 1000, 2);
        meridian.col(1001) << radius, edge - height;
        const shapes::AxisymmetricPart cup = shapes::axisymmetric(meridian, triangles);
        UnfoldPick pick;
        for (int f = 0; f < cup.mesh.triangles(); ++f)
            (cup.mesh.position.row(2)(cup.mesh.triangle.col(f)).mean() > edge ? pick.fixed : pick.freed).push_back(f);
        pick.target = paraboloid;
        const UnfoldStepResult result = unfold_step(cup.mesh, cup.mesh.position, pick, steel(r));
        ASSERT_TRUE(result.converged()) << result.piece[0].report.reason;
        shapes::HeldFlange wall{shapes::Profile({radius, 0}, -pi / 2).straight(height), swift, 206000, r, 0.8};
        wall.slope = [&](double R) { return -2 * crown * R; };
        const double truth = shapes::held_flange_blank(wall).R.tail(1)[0];
        h.push_back(shapes::mean_edge(cup.mesh));
        error.push_back(std::abs(mean_radius(result.position, cup.rim) / truth - 1));
        std::printf("crowned cup, %d triangles: R0 %.4f (%.2e), %zu Newton steps, %.2f s\n", triangles, truth,
                    error.back(), result.piece[0].report.newton.size(), result.seconds);
    }
    EXPECT_LT(error.back(), 2e-4);
    EXPECT_GT(shapes::convergence_order(h, error), 1.5);
}

TEST(UnfoldStep, ARingAllAroundACylinderOrAConeConvergesToTheSolutionAlongItsMeridian)
{
    // A fixed wall and a straight end that leans another way, all around; radians of their headings
    // in (r, z).
    struct Case {
        const char* name;
        double wall, end, length;
    };
    // slope of what stands for a cylinder
    constexpr double degree = pi / 180, radius = 40, steep = 1e6;
    for (const Case& c : {Case{"flared tube", 90, 50, 18},
                          {"collar of a tube", 90, 0, 10},
                          {"necked tube", 90, 120, 18},
                          {"flared cone", 70, 35, 15},
                          {"necked cone", 110, 140, 14}}) {
        const double r = 1.77;
        const auto heading = [](double angle) {
            return Eigen::Vector2d(std::cos(angle * degree), std::sin(angle * degree));
        };
        const bool inwards = c.end > 90;
        Eigen::Matrix2Xd meridian(2, 3); // from the axis outwards
        meridian.col(1) << radius, 0;
        meridian.col(inwards ? 0 : 2) = meridian.col(1) + c.length * heading(c.end);
        meridian.col(inwards ? 2 : 0) = meridian.col(1) - 20 * heading(c.wall);
        shapes::HeldFlange flange{shapes::Profile({radius, 0}, c.end * degree).straight(c.length), swift, 206000, r,
                                  0.8};
        const double slope = c.wall == 90 ? steep : std::tan(c.wall * degree);
        flange.slope = [&](double) { return slope; };
        const shapes::FlangeBlank truth = shapes::held_flange_blank(flange);
        // along the generators
        const double length = std::abs(truth.R.tail(1)[0] - radius) * std::hypot(1, slope);
        std::vector<double> h, error, thickness_error;
        for (const int triangles : {3000, 12000, 48000}) {
            const shapes::AxisymmetricPart part = shapes::axisymmetric(meridian, triangles);
            UnfoldPick pick;
            for (int f = 0; f < part.mesh.triangles(); ++f)
                (part.mesh.position.row(2)(part.mesh.triangle.col(f)).mean() < (c.end == 0 ? -1e-9 : 0) ? pick.fixed
                                                                                                        : pick.freed)
                    .push_back(f);
            const UnfoldStepResult result = unfold_step(part.mesh, part.mesh.position, pick, steel(r));
            ASSERT_TRUE(result.converged()) << result.piece[0].report.reason;
            EXPECT_EQ(name(result.target.face), c.wall == 90 ? "cylinder" : "cone");
            const std::vector<int> edge = inwards ? inner_edge(part) : part.rim;
            double found = 0, thickness = 0, count = 0;
            for (const int v : edge)
                found += result.position.col(v).dot(Eigen::Vector3d(0, 0, 1)) / std::abs(std::sin(c.wall * degree)) /
                         double(edge.size());
            for (size_t k = 0; k < result.freed.size(); ++k)
                for (const int v : part.mesh.triangle.col(result.freed[k]))
                    if (std::find(edge.begin(), edge.end(), v) != edge.end()) {
                        thickness += result.face.thickness[Eigen::Index(k)];
                        ++count;
                    }
            h.push_back(shapes::mean_edge(part.mesh));
            error.push_back(std::abs(found / length - 1));
            thickness_error.push_back(std::abs(thickness / count / truth.thickness.tail(1)[0] - 1));
            std::printf("%s, %d triangles: %.4f mm (%.2e), thickness %.4f (%.2e), %zu Newton steps, %.2f s\n", c.name,
                        triangles, length, error.back(), truth.thickness.tail(1)[0], thickness_error.back(),
                        result.piece[0].report.newton.size(), result.seconds);
        }
        EXPECT_LT(error.back(), 5e-4) << c.name;
        EXPECT_LT(thickness_error.back(), 5e-3) << c.name; // of the faces at the edge, whose
                                                           // middles lie beside it
        EXPECT_GT(shapes::convergence_order(h, error), 1.5) << c.name;
    }
}

TEST(UnfoldStep, HasTheSameBitsOnOneThreadAndOnTwo)
{
    const shapes::AxisymmetricPart cup = shapes::sharp_cup({.triangles = 12000});
    const UnfoldPick pick = all_onto_the_plane(cup.mesh);
    std::vector<Eigen::Matrix3Xd> position;
    for (const size_t threads : {1, 2}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        position.push_back(unfold_step(cup.mesh, cup.mesh.position, pick, steel(1.77)).position);
    }
    EXPECT_EQ(position[0], position[1]);
}

} // namespace spia::unfold_step_test
