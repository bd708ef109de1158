#include "engine/remesh/size_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "engine/remesh/remesh.h"
#include "tests/support/plane_faces.h"
#include "tests/support/samples.h"
#include "tests/support/shapes.h"

namespace spia {
namespace {

constexpr double nothing_asked = std::numeric_limits<double>::infinity();

/// 100 x 1 in two triangles, its corner in the origin.
TriMesh strip()
{
    TriMesh mesh{Eigen::Matrix3Xd::Zero(3, 4), Eigen::Matrix3Xi(3, 2)};
    mesh.position.row(0) << 0, 100, 100, 0;
    mesh.position.row(1) << 0, 0, 1, 1;
    mesh.triangle << 0, 0, 1, 2, 2, 3;
    return mesh;
}

SizeField field(const TriMesh& mesh, double at_vertices, double most)
{
    const Eigen::Index edges = Eigen::Index(edge_graph(mesh).edge.size());
    return {mesh,
            {Eigen::VectorXd::Constant(mesh.vertices(), at_vertices),
             Eigen::VectorXd::Constant(edges, nothing_asked),
             {},
             most,
             0.35}};
}

TEST(SizeField, GrowsFromBothEndsOfALongEdge)
{
    const TriMesh mesh = strip();
    const SizeField size = field(mesh, 0.5, 8);
    for (const double x : {0.0, 1.0, 10.0, 21.0, 22.0, 50.0, 79.0, 95.0, 100.0})
        EXPECT_NEAR(size.between(0, 1, x / 100), std::min(8.0, 0.5 + 0.35 * std::min(x, 100 - x)), 1e-9) << x;
}

TEST(SizeField, OfAShortFaceIsBetweenThoseAtItsCorners)
{
    const TriMesh plate = shapes::rectangle(4, 3, 4, 3);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> share(0, 1);
    EdgeSizes sizes = field(plate, 1, 5).sizes();
    for (double& size : sizes.at_vertex)
        size = 0.8 + 0.3 * share(random); // edges are 1 to 1.5
    const SizeField field(plate, sizes);
    for (int trial = 0; trial < 100; ++trial) {
        const int f = int(random() % unsigned(plate.triangles()));
        Eigen::Vector3d place(share(random), share(random), share(random));
        place /= place.sum();
        EXPECT_DOUBLE_EQ(field.in_face(f, place), place.dot(Eigen::Vector3d(sizes.at_vertex(plate.triangle.col(f)))));
    }
}

/// Of a dome whose edges are all long beside what its vertices ask for, a third of its edges, and
/// places between: the least that one of them allows, and no less than the corners have.
TEST(SizeField, IsTheLeastThatAllWhoAskAllow)
{
    const TriMesh dome = shapes::sample("dome").make(400);
    const EdgeGraph graph = edge_graph(dome);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> share(0, 1);
    EdgeSizes sizes = field(dome, 1, 6).sizes();
    for (double& size : sizes.at_vertex)
        size = 0.5 + 2 * share(random);
    for (double& size : sizes.along_edge)
        size = share(random) < 0.3 ? 1 + 3 * share(random) : nothing_asked;
    sizes.elsewhere = {{Eigen::Vector3d(20, 10, 5), 0.4}, {Eigen::Vector3d(-10, 30, 5), 0.8}};
    const SizeField field(dome, sizes);
    int beyond_corners = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const int f = int(random() % unsigned(dome.triangles()));
        const Eigen::Matrix3d corners = dome.position(Eigen::all, dome.triangle.col(f));
        const Eigen::Vector3d at_corners = sizes.at_vertex(dome.triangle.col(f));
        Eigen::Vector3d barycentric(share(random), share(random), share(random));
        barycentric /= barycentric.sum();
        const Eigen::Vector3d place = corners * barycentric;
        double allowed = sizes.most;
        for (int v = 0; v < dome.vertices(); ++v)
            allowed = std::min(allowed, sizes.at_vertex[v] + 0.35 * (dome.position.col(v) - place).norm());
        for (const EdgeSizes::Place& asking : sizes.elsewhere)
            allowed = std::min(allowed, asking.size + 0.35 * (asking.position - place).norm());
        for (size_t e = 0; e < graph.edge.size(); ++e) {
            const EdgeGraph::Edge& edge = graph.edge[e];
            const Eigen::Vector3d a = dome.position.col(edge.low), way = dome.position.col(edge.high) - a;
            const double at_ends = std::min(sizes.at_vertex[edge.low], sizes.at_vertex[edge.high]);
            if (edge.length <= 2 * at_ends)
                continue;
            const double t = std::clamp((place - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
            allowed = std::min(allowed, std::max(sizes.along_edge[Eigen::Index(e)], at_ends) +
                                            0.35 * (a + t * way - place).norm());
        }
        double longest = 0;
        for (int k = 0; k < 3; ++k)
            longest = std::max(longest, (corners.col(k) - corners.col((k + 1) % 3)).norm());
        const double known = barycentric.dot(at_corners);
        const bool is_long = longest > 2 * at_corners.minCoeff();
        const double expected = is_long ? std::max(known, allowed) : known;
        EXPECT_NEAR(field.in_face(f, barycentric), expected, 1e-12);
        beyond_corners += expected > known;
    }
    EXPECT_GT(beyond_corners, 100);
}

/// Sizes that grow from one side of a rectangle: the integral of 4 / (sqrt(3) size^2).
TEST(SizeField, CountsTheTrianglesThatItAsksFor)
{
    const double length = 40, width = 60, at_side = 0.5, growth = 0.35;
    TriMesh mesh{Eigen::Matrix3Xd::Zero(3, 4), Eigen::Matrix3Xi(3, 2)};
    mesh.position.row(0) << 0, length, length, 0;
    mesh.position.row(1) << 0, 0, width, width;
    mesh.triangle << 0, 0, 1, 2, 2, 3;
    EdgeSizes sizes = field(mesh, 1, 1e3).sizes();
    sizes.at_vertex << at_side, at_side + growth * length, at_side + growth * length, at_side;
    sizes.along_edge[edge_graph(mesh).find(0, 3)] = at_side;
    const double expected = 4 / std::sqrt(3.0) * width / growth * (1 / at_side - 1 / (at_side + growth * length));
    EXPECT_NEAR(SizeField(mesh, sizes).triangles(), expected, 0.05 * expected);
    const double even = 2.0;
    EXPECT_NEAR(field(mesh, even, even).triangles(), 4 / std::sqrt(3.0) * length * width / (even * even), 1e-6);
}

/// Plates drawn at random with a few small holes, in the needles that exporters make of them: as
/// many triangles as the good ones need, of which the same plate is made once more.
TEST(SizeField, NeedlesTakeAsManyTrianglesAsGoodOnesDo)
{
    std::mt19937 random(11);
    const auto between = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    for (int trial = 0; trial < 12; ++trial) {
        const double length = between(80, 200), width = between(40, 80), radius = between(0.5, 1.5);
        shapes::PlaneLoop outer = {{0, 0}, {length, 0}, {length, width}, {0, width}};
        std::vector<shapes::PlaneLoop> holes;
        const int across = 2 + trial % 3;
        for (int hole = 0; hole < across; ++hole) {
            const Eigen::Vector2d middle(length * (hole + between(0.3, 0.7)) / across, width * between(0.2, 0.8));
            shapes::PlaneLoop& loop = holes.emplace_back();
            for (int k = 24; k-- > 0;)
                loop.push_back(middle + radius * Eigen::Vector2d(std::cos(k * std::numbers::pi / 12),
                                                                 std::sin(k * std::numbers::pi / 12)));
        }
        std::vector<Eigen::Vector2d> points = outer;
        for (const shapes::PlaneLoop& hole : holes)
            points.insert(points.end(), hole.begin(), hole.end());
        const std::vector<std::array<int, 3>> triangles = shapes::long_triangles(outer, holes);
        TriMesh needles{Eigen::Matrix3Xd::Zero(3, Eigen::Index(points.size())),
                        Eigen::Matrix3Xi(3, Eigen::Index(triangles.size()))};
        for (size_t i = 0; i < points.size(); ++i)
            needles.position.col(Eigen::Index(i)).head<2>() = points[i];
        for (size_t i = 0; i < triangles.size(); ++i)
            needles.triangle.col(Eigen::Index(i)) << triangles[i][0], triangles[i][1], triangles[i][2];
        const RemeshOptions options{4.0, 0.05};
        const RemeshResult once = remesh(needles, options), again = remesh(once.mesh, options);
        EXPECT_LT(once.mesh.triangles(), 1.2 * again.mesh.triangles()) << trial;
        EXPECT_GT(once.mesh.triangles(), 0.8 * again.mesh.triangles()) << trial;
        EXPECT_GT(once.after.least_angle_of_99, 30 * std::numbers::pi / 180) << trial;
    }
}

} // namespace
} // namespace spia
