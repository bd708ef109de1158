#include "app/viewer/views/surface_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/viewer/views/palette.h"
#include "tests/support/joined_patches.h"
#include "tests/support/known_surfaces.h"
#include "tests/support/shapes.h"

namespace spia::viewer {
namespace {

/// A quarter of a cylinder about the x axis, exact, 100 mm long.
NurbsSurface cylinder(double radius)
{
    NurbsSurface s = surfaces::one_span(1, 2);
    s.control << 0, 100, 0, 100, 0, 100, radius, radius, radius, radius, 0, 0, 0, 0, radius, radius, radius, radius;
    const double w = std::sqrt(0.5);
    s.weight << 1, 1, w, w, 1, 1;
    return s;
}

/// z = (x^2 - y^2) / (2 a) over a square of side 2 h about the origin, exact.
NurbsSurface saddle(double h, double a)
{
    NurbsSurface s;
    s.degree_u = s.degree_v = 2;
    s.count_u = s.count_v = 3;
    s.knots_u = s.knots_v = {0, 0, 0, 1, 1, 1};
    s.control.resize(3, 9);
    // Bezier coefficients of x and x^2
    const double x[] = {-h, 0, h}, xx[] = {h * h, -h * h, h * h};
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
            s.control.col(s.index(i, j)) << x[i], x[j], (xx[i] - xx[j]) / (2 * a);
    s.weight = Eigen::VectorXd::Ones(9);
    return s;
}

const TriMesh plane = shapes::rectangle(120, 80, 6, 4);
const DrawnPart part{plane, plane.triangles()};

} // namespace

TEST(SurfaceCurvature, OfACylinderIsHalfTheInverseRadiusAndItsGaussianZero)
{
    const NurbsSurface surface = cylinder(40);
    const Tessellation drawn = tessellate(surface, 5);
    const Eigen::VectorXd mean = surface_curvature(surface, drawn, false),
                          gauss = surface_curvature(surface, drawn, true);
    for (int v = 0; v < drawn.mesh.vertices(); ++v) {
        EXPECT_NEAR(std::abs(mean[v]), 1 / 80., 1e-12);
        EXPECT_NEAR(gauss[v], 0, 1e-12);
    }
    EXPECT_NEAR(mean.maxCoeff() - mean.minCoeff(), 0, 1e-12) << "one sign";
}

TEST(SurfaceCurvature, OfASaddleIsNegativeAsInItsClosedForm)
{
    const double a = 30;
    const NurbsSurface surface = saddle(20, a);
    const Tessellation drawn = tessellate(surface, 6);
    const Eigen::VectorXd gauss = surface_curvature(surface, drawn, true),
                          mean = surface_curvature(surface, drawn, false);
    for (int v = 0; v < drawn.mesh.vertices(); ++v) {
        const double x = drawn.mesh.position(0, v), y = drawn.mesh.position(1, v), g = 1 + (x * x + y * y) / (a * a);
        EXPECT_NEAR(gauss[v], -1 / (a * a * g * g), 1e-12);
        EXPECT_NEAR(mean[v], (y * y - x * x) / (2 * a * a * a * std::pow(g, 1.5)), 1e-12);
    }
}

TEST(PatchColours, AreNeverThoseOfANeighbour)
{
    for (const patches::Sample& sample : patches::samples()) {
        const std::vector<int> colour = patch_colours(sample.patches);
        for (const PatchInterface& joint : sample.patches.interfaces)
            if (joint.first.patch != joint.second.patch) {
                EXPECT_NE(colour[size_t(joint.first.patch)], colour[size_t(joint.second.patch)]) << sample.name;
            }
        const StageShape shape = surface_shape(sample.patches, part, SurfaceLook::patches, 0.1);
        Eigen::Index triangles = 0;
        for (const SceneLayer& layer : shape.layers)
            triangles += layer.mesh->triangle.cols();
        Eigen::Index whole = 0;
        for (const SceneLayer& layer : surface_shape(sample.patches, part, SurfaceLook::plain, 0.1).layers)
            whole += layer.mesh->triangle.cols();
        EXPECT_EQ(triangles, whole) << sample.name;
        EXPECT_EQ(shape.layers.size() > 1, sample.patches.patch.size() > 1) << sample.name;
    }
}

TEST(SurfaceShape, TheMiddleOfThreeBandsIsTheTolerance)
{
    NurbsSurface flat = saddle(20, 30);
    flat.control.row(0).array() += 60;
    flat.control.row(1).array() += 40;
    flat.control.row(2).setConstant(0.25);
    const StageShape shape = surface_shape({{flat}, {}}, part, SurfaceLook::tolerance, 0.1);
    ASSERT_EQ(shape.layers.size(), 1u);
    const ColourScale& scale = shape.layers[0].scale;
    EXPECT_EQ(scale.bands, 3);
    EXPECT_FLOAT_EQ(scale.greatest, 0.3f);
    EXPECT_FLOAT_EQ(scale.least, -0.3f);
    EXPECT_NEAR(shape.layers[0].field->value.minCoeff(), 0.25, 1e-6);
    EXPECT_NEAR(shape.layers[0].field->value.maxCoeff(), 0.25, 1e-6);
}

TEST(SurfaceShape, HasNoCellsThatHolesCouldNotBeSeenIn)
{
    // One span as long as the part, whose hole is hatched cell by cell.
    const StageShape shape = surface_shape({{cylinder(40)}, {}}, part, SurfaceLook::deviation, 0.1);
    const SceneMesh& mesh = *shape.layers.front().mesh;
    float longest = 0;
    for (Eigen::Index e = 0; e < mesh.edge.cols(); ++e)
        longest = std::max(longest, (mesh.position.col(mesh.edge(0, e)) - mesh.position.col(mesh.edge(1, e))).norm());
    EXPECT_LT(longest, 0.01 * std::hypot(120, 80));
}

TEST(SurfaceShape, HasTheNormalsOfTheSurface)
{
    const NurbsSurface surface = cylinder(40);
    const StageShape shape = surface_shape({{surface}, {}}, part, SurfaceLook::zebra, 0.1);
    ASSERT_EQ(shape.layers.size(), 1u);
    EXPECT_TRUE(shape.layers[0].zebra);
    const SceneMesh& mesh = *shape.layers[0].mesh;
    for (Eigen::Index v = 0; v < mesh.position.cols(); ++v) {
        const Eigen::Vector3d place = mesh.origin + mesh.position.col(v).cast<double>();
        const Eigen::Vector3d outwards(0, place.y() / 40, place.z() / 40);
        EXPECT_NEAR(std::abs(mesh.normal.col(v).cast<double>().dot(outwards)), 1, 1e-5);
    }
}

TEST(ControlNet, HasThePointsOfAllPatches)
{
    for (const patches::Sample& sample : patches::samples()) {
        Eigen::Index points = 0, lines = 0;
        for (const NurbsSurface& s : sample.patches.patch) {
            points += s.control.cols();
            lines += (s.count_u - 1) * s.count_v + s.count_u * (s.count_v - 1);
        }
        const StageShape shape = control_net_shape(sample.patches, true, 1);
        EXPECT_EQ(shape.points.at(0)->point.cols(), points);
        EXPECT_EQ(shape.lines.at(0)->point.cols(), 2 * lines);
        const Eigen::Vector3d first = sample.patches.patch.back().control.col(0);
        bool found = false; // of the last patch, too
        for (Eigen::Index i = 0; i < shape.lines[0]->point.cols(); ++i)
            found |= (shape.lines[0]->origin + shape.lines[0]->point.col(i).cast<double>() - first).norm() < 1e-3;
        EXPECT_TRUE(found) << sample.name;
        const StageShape nothing = control_net_shape(sample.patches, true, 0);
        EXPECT_TRUE(nothing.lines.empty() && nothing.points.empty());
        EXPECT_TRUE(nothing.box.isApprox(shape.box)) << "fitting the view does not depend on how it is drawn";
    }
}

TEST(ControlNet, IsFaintWhereItIsDenseAndGoneBeforeItCoversTheSurface)
{
    NurbsSurface plane; // 3 x 4 control points, 10 and 20 mm apart
    plane.degree_u = plane.degree_v = 2;
    plane.count_u = 3;
    plane.count_v = 4;
    plane.control.resize(3, 12);
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 3; ++i)
            plane.control.col(i + 3 * j) << 10 * i, 20 * j, 0;
    EXPECT_NEAR(control_net_spacing({{plane}, {}}), (8 * 10 + 9 * 20) / 17., 1e-12);
    EXPECT_EQ(control_net_spacing({}), 0);
    EXPECT_EQ(control_net_strength(3), 0);
    EXPECT_EQ(control_net_strength(15), 0.5);
    EXPECT_EQ(control_net_strength(100), 1);
}

} // namespace spia::viewer
