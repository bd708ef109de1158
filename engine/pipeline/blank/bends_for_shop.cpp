#include "engine/pipeline/blank/bends_for_shop.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// What a CAD file states of the face that has most of a region; nothing if that is no plane.
std::optional<Eigen::Vector3d> plane_of(const PartFile& part, const BendMap& map, int region)
{
    std::map<int, double> area; // by CAD face
    const Eigen::VectorXd size = area_vectors(part.mesh).colwise().norm();
    for (int f = 0; f < part.mesh.triangles(); ++f)
        if (map.label[f] == region)
            area[part.cad->face[size_t(part.source_face[size_t(f)])]] += size[f];
    const auto most = std::ranges::max_element(area, [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most == area.end() || part.cad->surface[size_t(most->first)].kind != StatedSurface::Kind::plane)
        return std::nullopt;
    return part.cad->surface[size_t(most->first)].direction;
}

} // namespace

BendMap bends_for_shop(const PartFile& part)
{
    BendLimits limits;
    const double sharp = limits.sharp;
    const bool stated =
        part.cad && !part.cad->surface.empty() && std::ranges::all_of(part.source_face, [&](int f) {
            return part.cad->surface[size_t(part.cad->face[size_t(f)])].kind != StatedSurface::Kind::other;
        });
    if (!stated)
        return find_bends(part.mesh, limits);
    limits.sharp = std::numbers::pi / 180; // a press brake is set no finer
    BendMap map = find_bends(part.mesh, limits);
    std::erase_if(map.bends, [&](const Bend& bend) { // those without faces come last: the others
                                                     // keep their labels
        if (bend.faces > 0 || bend.b < 0 || std::abs(bend.angle) > sharp)
            return false;
        const auto a = plane_of(part, map, bend.a), b = plane_of(part, map, bend.b);
        constexpr double alike = 0.1; // of the angle
        const double between = a && b ? std::atan2(a->cross(*b).norm(), std::abs(a->dot(*b))) : 0;
        return std::abs(between - std::abs(bend.angle)) > alike * std::abs(bend.angle);
    });
    return map;
}

} // namespace spia
