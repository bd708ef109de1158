#include "engine/unfold/plan/bend_zones.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/support/bent_parts.h"
#include "tests/support/plane_faces.h"
#include "tests/support/profile.h"

namespace spia {
namespace {

/// Faces with all corners so far from an axis are of that cylinder, as a CAD file states it.
std::vector<StatedSurface> stated(const TriMesh& part, const Eigen::Vector3d& axis, double radius)
{
    std::vector<StatedSurface> surface(size_t(part.triangles()));
    for (int f = 0; f < part.triangles(); ++f) {
        bool on = true;
        for (const int v : part.triangle.col(f)) {
            const Eigen::Vector3d p = part.position.col(v);
            on = on && std::abs((p - p.dot(axis) * axis).norm() - radius) < 1e-9;
        }
        surface[size_t(f)].kind = on ? StatedSurface::Kind::cylinder : StatedSurface::Kind::plane;
        surface[size_t(f)].direction = axis;
        surface[size_t(f)].radius = radius;
    }
    return surface;
}

TEST(BendZones, GoOverIntoTheSheetAlongTheirAxis)
{
    // A bend of 90 degrees between two flats, 20 mm wide.
    shapes::PlaneFaces bent;
    std::vector<Eigen::Vector2d> section{{-15, 5}};
    for (int i = 0; i <= 6; ++i)
        section.emplace_back(5 * std::sin(i * std::numbers::pi / 12), 5 * std::cos(i * std::numbers::pi / 12));
    section.emplace_back(5, -10);
    for (size_t i = 0; i + 1 < section.size(); ++i) {
        const auto at = [&](size_t k, double y) { return Eigen::Vector3d(section[k].x(), y, section[k].y()); };
        bent.add({at(i, 0), at(i + 1, 0), at(i + 1, 20), at(i, 20)});
    }
    const TriMesh bracket = bent.mesh();
    const auto zones = stated_zones(bracket, stated(bracket, {0, 1, 0}, 5));
    ASSERT_EQ(zones.size(), 1u);
    EXPECT_NEAR(zones[0].to - zones[0].from, std::numbers::pi / 2, 1e-12);
    // The wall of a cup is a cylinder, too, and no bend.
    const TriMesh cup = shapes::turned({{0, 0}, {20, 0}, {20, 15}, {0, 15}}, 24);
    const auto surface = stated(cup, {0, 0, 1}, 20);
    ASSERT_EQ(std::count_if(surface.begin(), surface.end(),
                            [](const auto& s) { return s.kind == StatedSurface::Kind::cylinder; }),
              48);
    EXPECT_TRUE(stated_zones(cup, surface).empty());
}

TEST(BendZones, GiveBendsTheRadiusOfTheirCylinder)
{
    const TriMesh part =
        shapes::extruded(shapes::Profile({0, 0}, 0).straight(40).bend(7.5, 1.2).straight(30), 120, 3000).mesh;
    BendMap map = find_bends(part);
    ASSERT_EQ(map.bends.size(), 1u);
    EXPECT_LT(map.bends[0].radius, 7.495) << "that of chords";
    take_radii(fitted_zones(part, map), map);
    EXPECT_NEAR(map.bends[0].radius, 7.5, 1e-6);
}

} // namespace
} // namespace spia
