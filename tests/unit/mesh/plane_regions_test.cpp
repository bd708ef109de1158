#include "engine/mesh/solid/fit/plane_regions.h"

#include <gtest/gtest.h>

#include "engine/mesh/face_neighbours.h"
#include "engine/mesh/topology.h"
#include "tests/support/shapes.h"
#include "tests/support/sheet_solid.h"

namespace spia::plane_regions_test {
namespace {

constexpr double within = 1e-3; // mm

struct Planes {
    TriMesh solid;
    Eigen::Matrix3Xd normal = area_vectors(solid);
    Eigen::Matrix3Xi neighbour = face_neighbours(solid.triangles(), edge_uses(solid.triangle));
    PlaneRegions regions = plane_regions(solid, normal, neighbour, within);

    Eigen::Index count() const { return regions.direction.cols(); }
    size_t loops() const
    {
        size_t sum = 0;
        for (const auto& of_plane : borders_of(regions, solid, neighbour))
            sum += of_plane.size();
        return sum;
    }
};

/// 60 x 40 mm with a hole of 20 x 20 mm.
TriMesh plate(double thickness)
{
    shapes::BentSheet sheet{shapes::rectangle(60, 40, 6, 4), {}, std::vector<int>(48)};
    const Eigen::Vector3d middle = sheet.mesh.position.rowwise().mean();
    sheet = shapes::without(sheet, [&](const Eigen::Vector3d& p) { return (p - middle).norm() < 10; });
    Eigen::Matrix3Xd inwards = Eigen::Matrix3Xd::Zero(3, sheet.mesh.vertices());
    inwards.row(2).setConstant(-thickness);
    return shapes::thickened(sheet.mesh, inwards);
}

} // namespace

TEST(PlaneRegions, AreTheSidesOfASolidAndTheirBorders)
{
    const Planes planes{plate(2)};
    EXPECT_EQ(planes.count(), 2 + 4 + 4);
    EXPECT_EQ(planes.loops(), 2 * 2 + 4 + 4u);
    for (int f = 0; f < planes.solid.triangles(); ++f) {
        const int p = planes.regions.of[size_t(f)];
        EXPECT_NEAR(planes.normal.col(f).normalized().dot(planes.regions.direction.col(p)), 1, 1e-12);
        for (const int v : planes.solid.triangle.col(f))
            EXPECT_NEAR(planes.solid.position.col(v).dot(planes.regions.direction.col(p)), planes.regions.level[p],
                        1e-9);
    }
}

TEST(PlaneRegions, TakeSliversInButNotTheOtherSide) { EXPECT_EQ(Planes{plate(within / 2)}.count(), 2); }

TEST(PlaneRegions, EndWhereTheSheetTurnsALittle)
{
    TriMesh mesh = shapes::rectangle(60, 40, 6, 4);
    EXPECT_EQ(Planes{mesh}.count(), 1);
    EXPECT_EQ(Planes{mesh}.loops(), 0u) << "nothing is beyond its border";
    const Eigen::VectorXd x = mesh.position.row(0).array() - mesh.position.row(0).mean();
    mesh.position.row(2) = 0.1 * x.cwiseAbs();
    EXPECT_EQ(Planes{mesh}.count(), 2);
}

TEST(PlaneRegions, LieAsTheirLargestTrianglesDo)
{
    TriMesh mesh = shapes::rectangle(60, 40, 6, 4);
    mesh.position.row(0).array() -= mesh.position(0, 0);
    for (int v = 0; v < mesh.vertices(); ++v)
        if (mesh.position(0, v) == 10)
            mesh.position(0, v) = 0.01;
    mesh.position(2, 0) = within / 2; // the first triangle, a narrow one, is tilted
    EXPECT_EQ(Planes{mesh}.count(), 1);
}

} // namespace spia::plane_regions_test
