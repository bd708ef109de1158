#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "app/viewer/model/picking/clear_sight.h"
#include "engine/mesh/pick.h"
#include "tests/support/mesh_tools.h"
#include "tests/support/shapes.h"

namespace spia::viewer {
namespace {

/// A box of 100 x 100 x 100 mm about the origin without its face at x = -50.
TriMesh open_box()
{
    TriMesh box;
    box.position.resize(3, 8);
    for (int v = 0; v < 8; ++v)
        box.position.col(v) << (v & 1 ? 50 : -50), (v & 2 ? 50 : -50), (v & 4 ? 50 : -50);
    box.triangle.resize(3, 10);
    const int quads[5][4] = {{1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int q = 0; q < 5; ++q) {
        box.triangle.col(2 * q) << quads[q][0], quads[q][1], quads[q][2];
        box.triangle.col(2 * q + 1) << quads[q][0], quads[q][2], quads[q][3];
    }
    return box;
}

Eigen::Vector3d towards(const glm::dquat& turn)
{
    const glm::dvec3 z = turn * glm::dvec3(0, 0, 1);
    return {z.x, z.y, z.z};
}

const glm::dquat from_above{1, 0, 0, 0};

} // namespace

TEST(ClearSight, KeepsTheTurnFromWhichThePlaceIsSeen)
{
    EXPECT_EQ(clear_sight(open_box(), {10, 5, 50}, from_above), from_above);
    const glm::dquat below = glm::angleAxis(glm::pi<double>(), glm::dvec3(0, 1, 0));
    EXPECT_EQ(clear_sight(open_box(), {10, 5, -50}, below), below);
}

TEST(ClearSight, TurnsToWhereNothingStandsBeforeThePlace)
{
    const TriMesh box = open_box();
    const RayPicker picker(box);
    for (const Eigen::Vector3d& place :
         {Eigen::Vector3d(10, 5, -50), Eigen::Vector3d(50, 3, 4), Eigen::Vector3d(-20, -50, 10)}) {
        const Eigen::Vector3d way = towards(clear_sight(box, place, from_above));
        const RayHit hit = picker.first(place + 1000 * way, -way);
        EXPECT_NEAR(hit.distance, 1000, 1e-6) << place.transpose() << " is hidden from " << way.transpose();
    }
    // Of the bottom the nearest clear way is through the open side, aslant: straight up is the lid.
    EXPECT_GT(towards(clear_sight(box, {-40, 0, -50}, from_above)).z(), 0);
}

TEST(ClearSight, DoesNotLookAlongTheSheet)
{
    const TriMesh box = open_box();
    const Eigen::Vector3d way =
        towards(clear_sight(box, {50, 3, 4}, from_above)); // the top lies over that wall's plane
    EXPECT_GT(std::abs(way.x()), 0.4);
}

TEST(ClearSight, TurnsWhereASheetIsSeenAtLessThan17Degrees)
{
    const TriMesh box = open_box();
    const auto tilted = [](double above_sheet_deg) {
        return glm::angleAxis(glm::radians(90 - above_sheet_deg), glm::dvec3(0, 1, 0));
    };
    EXPECT_EQ(clear_sight(box, {10, 5, 50}, tilted(18)), tilted(18));
    EXPECT_GT(towards(clear_sight(box, {10, 5, 50}, tilted(16))).z(), 0.4);
}

TEST(ClearSight, GivesUpWhereAPlaceIsHiddenFromEverySide)
{
    TriMesh box = open_box();
    box.triangle.conservativeResize(3, 12);
    box.triangle.col(10) << 0, 4, 6;
    box.triangle.col(11) << 0, 6, 2;
    EXPECT_EQ(clear_sight(box, {0, 0, 0}, from_above), from_above);
    EXPECT_EQ(clear_sight({}, {0, 0, 0}, from_above), from_above);
}

} // namespace spia::viewer
