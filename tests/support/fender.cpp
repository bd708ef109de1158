#include "tests/support/fender.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/profile.h"
#include "tests/support/relief.h"

namespace spia::shapes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The layout, mm: u along the panel, v across it, both from its middle.
constexpr double u_end = 400, v_low = -240, v_bend = 240; // the flange is bent off at v_bend
constexpr double slant = 0.15;                            // of the two ends
const Circle wheel{{-40, -330}, 230};
constexpr double arch_end = 40; // radius where the arch leaves the lower side

/// The panel without its flange, continued smoothly to all sides.
Vector3d skin(double u, double v)
{
    const Step feature_line(7, 90, 60); // two arcs of 60 mm radius, 40 mm from edge to edge
    const double across = v - 70 - 0.06 * u;
    const double z = -u * u / (2 * 1800) - v * v / (2 * 700) + feature_line(across + feature_line.run() / 2);
    return {u + slant * v, v, z};
}

/// The frame at the edge where the flange begins: along the edge, across it in the tangent plane,
/// normal.
Eigen::Matrix3d edge_frame(double u)
{
    constexpr double step = 1e-3; // mm
    const Vector3d along = (skin(u + step, v_bend) - skin(u - step, v_bend)).normalized();
    const Vector3d across = skin(u, v_bend + step) - skin(u, v_bend - step);
    const Vector3d normal = along.cross(across).normalized();
    Eigen::Matrix3d frame;
    frame << along, normal.cross(along), normal;
    return frame;
}

} // namespace

ParametricMesh fender(const Fender& shape)
{
    const Profile flange = Profile({0, 0}, 0)
                               .bend(shape.bend_radius, -shape.flange_angle_deg * std::numbers::pi / 180)
                               .straight(shape.flange_width);
    const auto surface = [&](const Vector2d& p) -> Vector3d {
        if (p.y() <= v_bend)
            return skin(p.x(), p.y());
        const Vector2d bent = flange.at(p.y() - v_bend); // across the edge, along the normal
        return skin(p.x(), v_bend) + edge_frame(p.x()).rightCols<2>() * bent;
    };

    Region region;
    region.low = {-u_end, v_low};
    region.high = {u_end, v_bend + flange.length()};
    region.corners = {region.low, {u_end, v_low}, region.high, {-u_end, region.high.y()}};
    region.smallest_feature = arch_end;
    region.distance = [&](const Vector2d& p) {
        const double box = box_distance(p, (region.low + region.high) / 2, (region.high - region.low) / 2, 0);
        // Only the lower side runs into the arch; the other three stay sharp.
        return std::max(box, rounded_intersection(v_low - p.y(), -wheel.distance(p), arch_end));
    };
    return mesh_surface(region, surface, shape.triangles,
                        [&](const Vector2d& p) { return arch_end / 2 + std::abs(wheel.distance(p)); });
}

} // namespace spia::shapes
