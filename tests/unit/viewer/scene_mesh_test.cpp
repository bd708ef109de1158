#include "app/viewer/views/scene_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "app/viewer/views/marking.h"
#include "engine/mesh/topology.h"
#include "tests/support/shapes.h"

namespace spia::viewer {
namespace {

/// A strip folded by an angle along the line x = 0, columns x rows cells on each side.
TriMesh folded_strip(double angle_deg, int columns = 4, int rows = 3)
{
    TriMesh mesh = shapes::rectangle(20, 12, 2 * columns, rows);
    for (int v = 0; v < mesh.vertices(); ++v) {
        double& x = mesh.position(0, v);
        x -= 10;
        if (x > 0) {
            mesh.position(2, v) = x * std::sin(angle_deg * EIGEN_PI / 180);
            x *= std::cos(angle_deg * EIGEN_PI / 180);
        }
    }
    return mesh;
}

Eigen::Vector3d face_normal(const TriMesh& mesh, int face) { return area_vectors(mesh).col(face).normalized(); }

TEST(SceneMesh, ASharpEdgeIsLitAsTwoPlanes)
{
    const TriMesh part = folded_strip(60);
    const SceneMesh scene = scene_mesh(part);
    EXPECT_EQ(scene.repeated.size(), 4u) << "the vertices of the fold";
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            EXPECT_LT((scene.normal.col(scene.triangle(k, f)).cast<double>() - face_normal(part, f)).norm(), 1e-6);
}

TEST(SceneMesh, ASoftBendIsLitAsOneAndHasNoFeature)
{
    const TriMesh part = folded_strip(20);
    const SceneMesh scene = scene_mesh(part);
    EXPECT_TRUE(scene.repeated.empty());
    EXPECT_EQ(scene.feature.cols(), boundary_edges(part).cols());
    for (int v = 0; v < part.vertices(); ++v)
        if (std::abs(part.position(0, v)) < 1e-9) { // leans back by half the angle
            EXPECT_NEAR(std::atan2(-scene.normal(0, v), scene.normal(2, v)) * 180 / EIGEN_PI, 10, 4);
        }
}

TEST(SceneMesh, AllCornersKeepTheirPlaceAndFacesTheirNumber)
{
    const TriMesh part = folded_strip(75);
    const SceneMesh scene = scene_mesh(part);
    ASSERT_EQ(scene.triangle.cols(), part.triangle.cols());
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d seen = scene.position.col(scene.triangle(k, f)).cast<double>() + scene.origin;
            EXPECT_LT((seen - part.position.col(part.triangle(k, f))).norm(), 1e-5);
        }
}

TEST(SceneMesh, HasEveryEdgeOnce)
{
    const TriMesh part = shapes::plate();
    const SceneMesh scene = scene_mesh(part);
    std::set<std::set<uint32_t>> edges;
    for (const auto edge : scene.edge.colwise())
        edges.insert({edge[0], edge[1]});
    EXPECT_EQ(Eigen::Index(edges.size()), scene.edge.cols());
    // Euler: V - E + F = 2 - 3 for a disk with two holes, outside not counted.
    EXPECT_EQ(part.vertices() - scene.edge.cols() + part.triangles(), -1);
    Eigen::Index on_loops = 0;
    for (const auto& loop : boundary_loops(part))
        on_loops += Eigen::Index(loop.size());
    EXPECT_EQ(boundary_edges(part).cols(), on_loops);
}

TEST(SceneMesh, SharpEdgesAreFeaturesButNotAFewTrianglesThatHappenToMeetSharply)
{
    TriMesh fold = folded_strip(60, 4, 30);
    EXPECT_EQ(scene_mesh(fold).feature.cols(), boundary_edges(fold).cols() + 30);
    TriMesh dent = shapes::rectangle(200, 200, 200, 200);
    for (int v = 0; v < dent.vertices(); ++v)
        if ((dent.position.col(v).head<2>() - Eigen::Vector2d(100, 100)).norm() < 0.1)
            dent.position(2, v) = -1; // a pit of 1 mm radius on a plate of 283 mm diagonal
    EXPECT_EQ(scene_mesh(dent).feature.cols(), boundary_edges(dent).cols());
    EXPECT_FALSE(scene_mesh(dent).repeated.empty()) << "its light is sharp all the same";
}

TEST(SceneMesh, AFieldOfThePartReachesItsRepeatedVertices)
{
    const TriMesh part = folded_strip(60);
    const SceneMesh scene = scene_mesh(part);
    const Eigen::VectorXd values = part.position.row(1).transpose();
    const auto field = scene_field(scene, values, false);
    ASSERT_EQ(field->value.size(), scene.position.cols());
    for (Eigen::Index v = 0; v < scene.position.cols(); ++v)
        EXPECT_NEAR(field->value[v], scene.position(1, v) + scene.origin.y(), 1e-5);
}

TEST(FlatSceneMesh, LiesInThePlaneWithTheFacesOfThePart)
{
    const TriMesh part = folded_strip(60);
    const Eigen::Matrix2Xd plane = part.position.topRows<2>() * 2;
    const SceneMesh flat = flat_scene_mesh(part, scene_mesh(part), plane);
    ASSERT_EQ(flat.triangle.cols(), part.triangle.cols());
    EXPECT_EQ(flat.position.cols(), part.vertices());
    EXPECT_NEAR(flat.position.row(2).cwiseAbs().maxCoeff() + std::abs(flat.origin.z()), 0, 1e-12);
    for (int v = 0; v < part.vertices(); ++v)
        EXPECT_LT(((flat.position.col(v).cast<double>() + flat.origin).head<2>() - plane.col(v)).norm(), 1e-5);
}

double length(const SceneLines& lines)
{
    double sum = 0;
    for (Eigen::Index i = 0; i < lines.point.cols(); i += 2)
        sum += (lines.point.col(i) - lines.point.col(i + 1)).norm();
    return sum;
}

TEST(OutlineOfFaces, RunsAroundThemAcrossSharpEdges)
{
    const TriMesh part = folded_strip(60);
    const SceneMesh scene = scene_mesh(part);
    std::vector<int> all(size_t(part.triangles()));
    for (size_t f = 0; f < all.size(); ++f)
        all[f] = int(f);
    const LineList lines = outline_of_faces(scene, all, 2, false);
    ASSERT_EQ(lines.size(), 2u) << "a casing and a core";
    EXPECT_NEAR(length(*lines[1]), 2 * 20 + 2 * 12, 1e-3);
    EXPECT_NEAR(length(*outline_of_faces(scene, {0, 1}, 2, false)[1]), 2 * 2.5 + 2 * 4, 1e-3) << "one cell";
    EXPECT_TRUE(outline_of_faces(scene, {}, 2, false).empty());
    EXPECT_TRUE(outline_of_faces(scene, {-1, 100000}, 2, false).empty());
}

TEST(FaceMarks, SayRegionAndSelection)
{
    std::vector<FaceRegion> regions(2);
    regions[0].faces = {1, 2, 3};
    regions[1].faces = {3, 4, 99};
    const auto marks = face_marks(6, {2, 5}, regions);
    ASSERT_TRUE(marks);
    EXPECT_EQ(marks->mark, (std::vector<uint8_t>{0, 1, 1 | FaceMarks::selected, 2, 2, FaceMarks::selected}));
    EXPECT_FALSE(face_marks(6, {}, {}));
    EXPECT_FALSE(face_marks(6, {17}, {}));
}

} // namespace
} // namespace spia::viewer
