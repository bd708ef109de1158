#include "engine/compare/lscm.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/mesh/topology.h"
#include "tests/support/developable.h"
#include "tests/support/mesh_tools.h"
#include "tests/unit/compare/layouts.h"

namespace spia {

TEST(Lscm, LaysDevelopablePartsOutUpToASimilarity)
{
    const auto cylinder = shapes::quarter_cylinder({.triangles = 3000});
    const auto cone = shapes::cone_sector({.triangles = 3000});
    const auto channel = shapes::lipped_channel({.triangles = 3000});
    const TriMesh plane = shapes::rectangle(90, 40, 40, 20);
    const TriMesh holes = shapes::plate({.triangles = 3000});
    EXPECT_LT(distance_up_to_similarity(lscm(cylinder.mesh).position, cylinder.flat), 1e-8);
    EXPECT_LT(distance_up_to_similarity(lscm(cone.mesh).position, cone.flat), 1e-8);
    EXPECT_LT(distance_up_to_similarity(lscm(channel.mesh).position, channel.flat), 1e-8);
    EXPECT_LT(distance_up_to_similarity(lscm(plane).position, plane.position.topRows<2>()), 1e-8);
    EXPECT_LT(distance_up_to_similarity(lscm(holes).position, holes.position.topRows<2>()), 1e-8);
}

TEST(Lscm, StaysExactOnFineAndThinTriangles)
{
    // Here the normal equations alone lose half of the digits; the refinement brings them back.
    const TriMesh strip = shapes::rectangle(400, 4, 400, 40);
    EXPECT_LT(distance_up_to_similarity(lscm(strip).position, strip.position.topRows<2>()), 1e-8);
}

TEST(Lscm, HasTheAreaOfThePart)
{
    const TriMesh part = bumpy_plate();
    EXPECT_NEAR(flat_area(part, lscm(part).position), area(part), 1e-9 * area(part));
}

TEST(Lscm, IsTheLeastDifferenceBetweenStretchAndAreaAmongMapsWithTheSamePins)
{
    // Independent route: the conformal energy is half the Dirichlet energy (cotangents of the
    // corners) less the area of the map [Pinkall and Polthier 1993]. Its derivative must vanish at
    // every vertex but the two that are held.
    const TriMesh part = bumpy_disk();
    const std::array<int, 2> pins = {3, 40};
    const Eigen::Matrix2Xd u = lscm(part, {.pins = pins}).position;
    Eigen::Matrix2Xd gradient = Eigen::Matrix2Xd::Zero(2, part.vertices());
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int at = part.triangle(k, f), a = part.triangle((k + 1) % 3, f), b = part.triangle((k + 2) % 3, f);
            const Eigen::Vector3d p = part.position.col(a) - part.position.col(at);
            const Eigen::Vector3d q = part.position.col(b) - part.position.col(at);
            const Eigen::Vector2d pull = 0.5 * p.dot(q) / p.cross(q).norm() * (u.col(a) - u.col(b));
            gradient.col(a) += pull;
            gradient.col(b) -= pull;
            // the area grows by half of it turned, at corner `at`
            const Eigen::Vector2d edge = u.col(b) - u.col(a);
            gradient.col(at) -= 0.5 * Eigen::Vector2d(-edge[1], edge[0]);
        }
    EXPECT_GT(gradient.col(pins[0]).norm(), 1e-4); // what the pin holds
    gradient.col(pins[0]).setZero();
    gradient.col(pins[1]).setZero();
    EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-11 * u.cwiseAbs().maxCoeff());
}

TEST(Lscm, RefusesPinsThatAreNotTwoVertices)
{
    const TriMesh part = bumpy_disk();
    EXPECT_THROW(lscm(part, {.pins = std::array{2, 2}}), InputError);
    EXPECT_THROW(lscm(part, {.pins = std::array{0, part.vertices()}}), InputError);
}

TEST(Lscm, LaysOutATubeSlitOpenWhoseFarEndsTouch)
{
    // The two farthest vertices of the boundary may lie at one place in space.
    const auto cone =
        shapes::cone_sector({.near = 60, .far = 62, .half_angle_deg = 30, .sector_deg = 359.99, .triangles = 800});
    EXPECT_LT(distance_up_to_similarity(lscm(cone.mesh).position, cone.flat), 1e-7);
}

TEST(RequireSheet, SaysWhatThePartIsInstead)
{
    const auto complaint = [](const TriMesh& part) -> std::string {
        try {
            require_sheet(part);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(complaint(bumpy_plate()), "");
    EXPECT_NE(complaint(TriMesh{}).find("no faces"), std::string::npos);
    EXPECT_NE(complaint(shapes::closed_sphere(10, 200)).find("closed"), std::string::npos);
    EXPECT_NE(complaint(shapes::two_rectangles()).find("several pieces"), std::string::npos);
    TriMesh torus = shapes::torus(30, 10, 400);
    torus.triangle = torus.triangle.leftCols(torus.triangles() - 1).eval();
    EXPECT_NE(complaint(torus).find("1 handles"), std::string::npos);
    TriMesh stray = shapes::rectangle(2, 2, 2, 2);
    stray.position.conservativeResize(3, stray.vertices() + 1);
    stray.position.rightCols<1>().setConstant(5);
    EXPECT_NE(complaint(stray).find("vertex 9 belongs to no face"), std::string::npos);
    TriMesh collapsed = shapes::rectangle(2, 2, 2, 2);
    collapsed.position.col(collapsed.triangle(0, 5)) = collapsed.position.col(collapsed.triangle(1, 5));
    EXPECT_NE(complaint(collapsed).find("has no area"), std::string::npos);
}

} // namespace spia
