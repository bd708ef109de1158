#include "app/viewer/model/picking/clear_sight.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <glm/gtx/quaternion.hpp>
#include <vector>

#include "engine/mesh/closest_point.h"
#include "engine/mesh/topology.h"

namespace spia::viewer {
namespace {

/// Whether a triangle is met beyond `from` along the ray. One ray at a time, so that no search
/// structure pays.
bool meets(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& origin,
           const Eigen::Vector3d& direction, double from)
{
    const Eigen::Vector3d ab = b - a, ac = c - a, p = direction.cross(ac);
    const double det = ab.dot(p);
    if (det == 0)
        return false;
    const Eigen::Vector3d to = origin - a, q = to.cross(ab);
    const double u = to.dot(p) / det, v = direction.dot(q) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && ac.dot(q) / det > from;
}

bool hidden(const TriMesh& mesh, const Eigen::Vector3d& place, const Eigen::Vector3d& direction, double beside)
{
    for (int f = 0; f < mesh.triangles(); ++f) {
        const auto t = mesh.triangle.col(f);
        if (meets(mesh.position.col(t[0]), mesh.position.col(t[1]), mesh.position.col(t[2]), place, direction, beside))
            return true;
    }
    return false;
}

/// Of the face that is nearest; zero if it has no area.
Eigen::Vector3d normal_near(const TriMesh& mesh, const Eigen::Vector3d& place)
{
    double least = std::numeric_limits<double>::infinity();
    int nearest = 0;
    for (int f = 0; f < mesh.triangles(); ++f) {
        Eigen::Matrix3d corners;
        for (int k = 0; k < 3; ++k)
            corners.col(k) = mesh.position.col(mesh.triangle(k, f));
        const double distance = (corners * closest_on_triangle(corners, place) - place).squaredNorm();
        if (distance < least) {
            least = distance;
            nearest = f;
        }
    }
    const auto t = mesh.triangle.col(nearest);
    const Eigen::Vector3d a = mesh.position.col(t[0]), b = mesh.position.col(t[1]), c = mesh.position.col(t[2]);
    return (b - a).cross(c - a).normalized();
}

std::vector<Eigen::Vector3d> directions_around()
{
    std::vector<Eigen::Vector3d> all;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (x != 0 || y != 0 || z != 0)
                    all.push_back(Eigen::Vector3d(x, y, z).normalized());
    return all;
}

} // namespace

glm::dquat clear_sight(const TriMesh& mesh, const Eigen::Vector3d& place, const glm::dquat& turn)
{
    if (mesh.triangles() == 0)
        return turn;
    const auto beside = 2e-3 * bounding_diagonal(mesh); // mm: what is nearer is the sheet around
                                                        // the place itself
    const glm::dvec3 z = turn * glm::dvec3(0, 0, 1), y = turn * glm::dvec3(0, 1, 0);
    const Eigen::Vector3d now(z.x, z.y, z.z);
    const Eigen::Vector3d normal = normal_near(mesh, place); // not a number, which is less than
                                                             // nothing: no area
    // Sines of the angle between sight and sheet: below 17 degrees a place is hardly seen.
    constexpr double along = 0.3, across = 0.4;
    if (!(std::abs(now.dot(normal)) < along) && !hidden(mesh, place, now, beside))
        return turn;
    std::vector<Eigen::Vector3d> ways = directions_around();
    std::stable_sort(ways.begin(), ways.end(),
                     [&](const auto& a, const auto& b) { return a.dot(now) > b.dot(now) + 1e-12; });
    for (const Eigen::Vector3d& way : ways) {
        if (std::abs(way.dot(normal)) < across || hidden(mesh, place, way, beside))
            continue;
        const glm::dvec3 to(way[0], way[1], way[2]);
        constexpr double opposite = -1 + 1e-9;
        const glm::dquat change = way.dot(now) < opposite ? glm::angleAxis(glm::pi<double>(), y) : glm::rotation(z, to);
        return glm::normalize(change * turn);
    }
    return turn;
}

} // namespace spia::viewer
