#include "engine/mesh/solid/stated_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "engine/mesh/solid/off_axis.h"
#include "engine/mesh/solid/thin_solid.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

using Kind = StatedSurface::Kind;

// CAD systems write 8 to 15 digits of directions and lengths.
constexpr double parallel = 1e-7, alike = 1e-6;

/// A surface of a skin and its area there.
struct SkinSurface {
    StatedSurface surface;
    SheetSide side;
    double area = 0;
};

} // namespace

Eigen::Vector3d normal_at(const StatedSurface& surface, const Eigen::Vector3d& place, const Eigen::Vector3d& towards)
{
    if (surface.kind == Kind::other)
        return towards;
    const Eigen::Vector3d normal =
        surface.kind == Kind::plane ? surface.direction : off_axis(surface, place).normalized();
    return normal.dot(towards) < 0 ? Eigen::Vector3d(-normal) : normal;
}

double unrolled_area(const StatedSurface& cylinder, const Eigen::Matrix3d& corner)
{
    const auto at = [&](int k) {
        const Eigen::Vector3d u = off_axis(cylinder, corner.col(0)), v = off_axis(cylinder, corner.col(k));
        return Eigen::Vector2d(cylinder.radius * std::atan2(u.cross(v).dot(cylinder.direction), u.dot(v)),
                               (corner.col(k) - corner.col(0)).dot(cylinder.direction));
    };
    const Eigen::Vector2d a = at(1), b = at(2);
    return (a.x() * b.y() - a.y() * b.x()) / 2;
}

double distance_between(const StatedSurface& a, const StatedSurface& b, double size)
{
    if (a.kind != b.kind || a.kind == Kind::other || a.direction.cross(b.direction).norm() > parallel)
        return 0;
    if (a.kind == Kind::plane)
        return std::abs((b.point - a.point).dot(a.direction));
    return off_axis(a, b.point).norm() > alike * size ? 0 : std::abs(a.radius - b.radius);
}

bool same_cylinder(const StatedSurface& a, const StatedSurface& b)
{
    return a.kind == Kind::cylinder && b.kind == Kind::cylinder && std::abs(a.radius - b.radius) <= alike * a.radius &&
           a.direction.cross(b.direction).norm() <= alike && off_axis(a, b.point).norm() <= 1e-4 * a.radius;
}

double stated_thickness(const TriMesh& solid, const ThinSolid& sheet, const std::vector<StatedSurface>& surface)
{
    using Key = std::tuple<int, int, double, double, double, double, double, double, double>;
    std::map<Key, SkinSurface> known;
    const Eigen::VectorXd size = area_vectors(solid).colwise().norm();
    for (int f = 0; f < solid.triangles(); ++f) {
        const StatedSurface& s = surface[size_t(f)];
        const SheetSide side = sheet.side[size_t(f)];
        if (s.kind == Kind::other || side == SheetSide::rim)
            continue;
        const Key key{int(s.kind),     int(side),       s.point.x(),     s.point.y(), s.point.z(),
                      s.direction.x(), s.direction.y(), s.direction.z(), s.radius};
        SkinSurface& one = known.try_emplace(key, SkinSurface{s, side}).first->second;
        one.area += size[f];
    }
    // Chords, and rays that do not go straight across, are off by less than this.
    constexpr double about = 0.03, one_value = 1e-6;
    const double diagonal = bounding_diagonal(solid);
    std::vector<std::pair<double, double>> found; // thickness, area
    for (const auto& [_, a] : known)
        for (const auto& [__, b] : known)
            if (a.side == SheetSide::outer && b.side == SheetSide::inner)
                if (const double t = distance_between(a.surface, b.surface, diagonal);
                    std::abs(t - sheet.thickness) <= about * sheet.thickness)
                    found.emplace_back(t, std::min(a.area, b.area));
    std::sort(found.begin(), found.end());
    double best = sheet.thickness, most = 0;
    for (size_t i = 0; i < found.size();) {
        size_t end = i;
        double sum = 0, largest = 0, value = found[i].first;
        for (; end < found.size() && found[end].first <= found[i].first * (1 + one_value); ++end) {
            sum += found[end].second;
            if (found[end].second > largest) {
                largest = found[end].second;
                value = found[end].first;
            }
        }
        if (sum > most) {
            most = sum;
            best = value;
        }
        i = end;
    }
    // A length that was computed from a sum of others, e.g. 2.0000000000000004: a part in a million
    // million is its rounding.
    const double digits = std::pow(10, 11 - std::floor(std::log10(best)));
    return std::round(best * digits) / digits;
}

} // namespace spia
