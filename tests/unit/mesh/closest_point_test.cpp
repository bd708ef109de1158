#include "engine/mesh/closest_point.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <random>

#include "engine/core/error.h"
#include "engine/mesh/box_tree.h"
#include "tests/support/shapes.h"

namespace spia::closest_point_test {

namespace {

std::mt19937 random_numbers(7);

Eigen::Vector3d random_point(double size)
{
    std::uniform_real_distribution<double> coordinate(-size, size);
    return {coordinate(random_numbers), coordinate(random_numbers), coordinate(random_numbers)};
}

/// A place of a convex set is the nearest one to a point exactly if no corner of the set lies on
/// the point's side of the plane through the place. How far the farthest corner is on the wrong
/// side, mm.
double on_the_wrong_side(const Eigen::Matrix3d& triangle, const Eigen::Vector3d& place, const Eigen::Vector3d& point)
{
    const double distance = (point - place).norm();
    if (distance == 0)
        return 0;
    return ((point - place).transpose() / distance * (triangle.colwise() - place)).maxCoeff();
}

TriMesh soup(int triangles, double size)
{
    TriMesh mesh;
    mesh.position.resize(3, 3 * triangles);
    mesh.triangle.resize(3, triangles);
    for (int f = 0; f < triangles; ++f) {
        const Eigen::Vector3d centre = random_point(100);
        for (int k = 0; k < 3; ++k) {
            mesh.position.col(3 * f + k) = centre + random_point(size);
            mesh.triangle(k, f) = 3 * f + k;
        }
    }
    return mesh;
}

} // namespace

TEST(ClosestPoint, NoCornerOfTheTriangleLiesBeyondTheNearestPlace)
{
    for (int i = 0; i < 5000; ++i) {
        Eigen::Matrix3d triangle;
        triangle << random_point(10), random_point(10), random_point(10);
        const Eigen::Vector3d point = random_point(15);
        const Eigen::Vector3d b = closest_on_triangle(triangle, point);
        EXPECT_GE(b.minCoeff(), 0);
        EXPECT_NEAR(b.sum(), 1, 1e-14);
        EXPECT_LT(on_the_wrong_side(triangle, triangle * b, point), 1e-7);
    }
}

TEST(ClosestPoint, NeedlesAndPointsAreNoTrap)
{
    for (double thickness : {1e-3, 1e-6, 1e-7, 1e-8, 1e-10, 1e-14, 0.}) {
        Eigen::Matrix3d needle; // lies along (1, 2, 2), its third corner beside the middle
        needle << Eigen::Vector3d(-5, -10, -10), Eigen::Vector3d(10, 20, 20), Eigen::Vector3d(3, 6, 6 + thickness);
        const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 2) / 3, aside = Eigen::Vector3d(2, -1, 0).normalized();
        for (double along : {-20., -3., 2., 25., 40.})
            for (double off : {0., 1e-3, 5.}) {
                const Eigen::Vector3d b = closest_on_triangle(needle, along * axis + off * aside);
                const double truth = std::hypot(off, std::max({0., -15 - along, along - 30}));
                // the needle is not thicker than this, and a foot is found to the root of the
                // precision
                const double tolerance = thickness + 1e-6;
                EXPECT_NEAR((needle * b - along * axis - off * aside).norm(), truth, tolerance) << thickness;
                EXPECT_TRUE(b.allFinite() && b.minCoeff() >= 0);
            }
    }
    const Eigen::Matrix3d point = Eigen::Vector3d(1, 2, 3).replicate<1, 3>();
    EXPECT_NEAR((point * closest_on_triangle(point, {1, 2, 7}) - Eigen::Vector3d(1, 2, 3)).norm(), 0, 1e-15);
}

TEST(ClosestPoint, SearchFindsWhatTryingAllFacesFinds)
{
    for (double size : {1., 20., 150.}) { // from grains far from each other to triangles all
                                          // through each other
        const TriMesh mesh = soup(700, size);
        const ClosestPointSearch search(mesh);
        for (int i = 0; i < 300; ++i) {
            const Eigen::Vector3d point = random_point(130);
            double truth = std::numeric_limits<double>::infinity();
            for (int f = 0; f < mesh.triangles(); ++f) {
                const Eigen::Matrix3d t = mesh.position.middleCols<3>(3 * f);
                truth = std::min(truth, (t * closest_on_triangle(t, point) - point).norm());
            }
            const ClosestPoint found = search.nearest(point);
            EXPECT_NEAR(found.distance, truth, 1e-12);
            EXPECT_NEAR((found.position - point).norm(), found.distance, 1e-12);
            const Eigen::Matrix3d t = mesh.position.middleCols<3>(3 * found.face);
            EXPECT_LT((t * found.barycentric - found.position).norm(), 1e-12);
        }
    }
}

/// Needles all through each other, some of them askew: their boxes are cut to pieces, the answers
/// are those of whole faces.
TEST(ClosestPoint, OfNeedlesItFindsTheSameBitsAsTryingAllOfThem)
{
    TriMesh mesh = soup(400, 60);
    for (int f = 0; f < mesh.triangles(); f += 2) // half of them thin, some without area
        mesh.position.col(3 * f + 2) = mesh.position.col(3 * f) + random_point(f % 8 == 0 ? 0 : 0.01);
    const ClosestPointSearch search(mesh);
    for (int i = 0; i < 3000; ++i) {
        const Eigen::Vector3d on = mesh.position.col(i % mesh.vertices());
        // at corners, too
        const Eigen::Vector3d point = i < mesh.vertices() ? on : random_point(100);
        int truth = -1;
        double least = std::numeric_limits<double>::infinity();
        for (int f = 0; f < mesh.triangles(); ++f) {
            const Eigen::Matrix3d t = mesh.position.middleCols<3>(3 * f);
            const Eigen::Vector3d place = t * closest_on_triangle(t, point);
            if (const double squared = (place - point).squaredNorm(); squared < least) {
                least = squared;
                truth = f;
            }
        }
        const ClosestPoint found = search.nearest(point);
        EXPECT_EQ(found.face, truth);
        EXPECT_EQ(found.distance, std::sqrt(least));
    }
}

/// What makes slivers cheap: how many boxes of leaves hold a place among needles that lie side by
/// side and askew.
TEST(BoxTree, PiecesOfNeedlesSideBySideHaveBoxesOfTheirOwn)
{
    const int needles = 400;
    TriMesh fan{Eigen::Matrix3Xd(3, 2 * needles + 2), Eigen::Matrix3Xi(3, 2 * needles)};
    for (int i = 0; i <= needles; ++i)
        for (const int end : {0, 1}) // from lower left to upper right
            fan.position.col(2 * i + end) = Eigen::Vector3d(0.05 * i + 50 * end, 50 * end - 0.05 * i, 0);
    for (int i = 0; i < needles; ++i) {
        fan.triangle.col(2 * i) << 2 * i, 2 * i + 1, 2 * i + 2;
        fan.triangle.col(2 * i + 1) << 2 * i + 1, 2 * i + 3, 2 * i + 2;
    }
    const auto boxes_at = [&](BoxTree::Boxes boxes, const Eigen::Vector3d& place) {
        const BoxTree tree(fan, boxes);
        EXPECT_LE(tree.face.size(), 100'000u);
        return std::count_if(tree.node.begin(), tree.node.end(),
                             [&](const BoxTree::Node& node) { return node.count > 0 && node.box.contains(place); });
    };
    const Eigen::Vector3d middle(35, 15, 0);
    EXPECT_GT(boxes_at(BoxTree::Boxes::whole, middle), 100);
    EXPECT_LT(boxes_at(BoxTree::Boxes::pieces, middle), 10);
}

TEST(ClosestPoint, AboveAPlaneItIsTheFootAndBesideItTheEdge)
{
    const ClosestPointSearch search(shapes::rectangle(30, 20, 6, 4));
    EXPECT_LT((search.nearest({11, 7, 5}).position - Eigen::Vector3d(11, 7, 0)).norm(), 1e-13);
    EXPECT_LT((search.nearest({-4, 7, 3}).position - Eigen::Vector3d(0, 7, 0)).norm(), 1e-13);
    EXPECT_NEAR(search.nearest({-4, 7, 3}).distance, 5, 1e-13);
    EXPECT_LT((search.nearest({33, 24, 0}).position - Eigen::Vector3d(30, 20, 0)).norm(), 1e-13);
}

TEST(ClosestPoint, OfEquallyNearFacesTheFirstIsFound)
{
    TriMesh mesh = shapes::rectangle(8, 8, 8, 8);
    // the first ones are not those of smallest coordinates
    mesh.triangle = mesh.triangle.rowwise().reverse().eval();
    const ClosestPointSearch search(mesh);
    for (int v = 0; v < mesh.vertices(); ++v) { // all faces around a vertex are equally near to it
        int first = mesh.triangles();
        for (int f = mesh.triangles() - 1; f >= 0; --f)
            if ((mesh.triangle.col(f).array() == v).any())
                first = f;
        EXPECT_EQ(search.nearest(mesh.position.col(v)).face, first);
    }
}

TEST(ClosestPoint, NothingIsFoundBeyondTheReach)
{
    const ClosestPointSearch search(shapes::rectangle(30, 20, 6, 4));
    EXPECT_EQ(search.nearest({11, 7, 5}, 4.9).face, -1);
    EXPECT_NEAR(search.nearest({11, 7, 5}, 5.1).distance, 5, 1e-13);
}

TEST(ClosestPoint, MeshWithoutFacesOrWithWrongVerticesIsRefused)
{
    EXPECT_THROW(ClosestPointSearch(TriMesh{}), InputError);
    TriMesh mesh = shapes::rectangle(30, 20, 3, 2);
    mesh.triangle(1, 4) = 99;
    EXPECT_THROW(ClosestPointSearch{mesh}, InputError);
    mesh = shapes::rectangle(30, 20, 3, 2);
    mesh.position(2, 5) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(ClosestPointSearch{mesh}, InputError);
}

} // namespace spia::closest_point_test
