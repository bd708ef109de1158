#include "engine/pipeline/blank/bends_for_shop.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "engine/mesh/topology.h"
#include "engine/mesh/vectors.h"

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

/// Whether a CAD file states that all faces are planes and cylinders.
bool is_stated(const PartFile& part)
{
    return part.cad && !part.cad->surface.empty() && std::ranges::all_of(part.source_face, [&](int f) {
               return part.cad->surface[size_t(part.cad->face[size_t(f)])].kind != StatedSurface::Kind::other;
           });
}

/// Radians, what CAD faces turn along the edge between two regions, the mean of its ends; nothing
/// where their normals are not known.
std::optional<double> stated_turn(const PartFile& part, const BendMap& map, const Bend& fold)
{
    double sum = 0, length = 0;
    for (const auto& [one, other] : edges_of(part.mesh, map, fold)) {
        const double edge = (part.mesh.position.col(one.high) - part.mesh.position.col(one.low)).norm();
        for (const int v : {one.low, one.high}) {
            const auto normal = [&](int f) {
                return part.corner_normal[size_t(f)].col(part.mesh.corner_of(f, v)).cast<double>().eval();
            };
            const Eigen::Vector3d a = normal(one.face), b = normal(other.face);
            if (a.isZero() || b.isZero())
                continue;
            sum += edge * angle_between(a, b);
            length += edge;
        }
    }
    return length > 0 ? std::optional(sum / length) : std::nullopt;
}

/// Edges between facets of a smooth CAD face, or of two that go over into each other, are none of
/// the part.
void leave_out_smooth(const PartFile& part, BendMap& map)
{
    constexpr double folded = 0.5; // of what the facets turn
    if (!part.corner_normal.empty())
        std::erase_if(map.bends, [&](const Bend& bend) { // those without faces come last: the others keep their labels
            if (bend.faces > 0 || bend.b < 0)
                return false;
            const auto turn = stated_turn(part, map, bend);
            return turn && *turn < folded * std::abs(bend.angle);
        });
}

} // namespace

BendMap bends_for_steps(const PartFile& part)
{
    BendLimits limits;
    if (!is_stated(part))
        return find_bends(part.mesh, limits);
    double widest = 0; // mm
    bool flat = false;
    for (const int f : part.source_face) {
        const StatedSurface& surface = part.cad->surface[size_t(part.cad->face[size_t(f)])];
        flat |= surface.kind == StatedSurface::Kind::plane;
        if (surface.kind == StatedSurface::Kind::cylinder)
            widest = std::max(widest, surface.radius);
    }
    constexpr double below = 0.5; // so that chords of it are above
    if (flat && widest > 0)
        limits.curvature = std::min(limits.curvature, below * std::sqrt(area(part.mesh)) / widest);
    return find_bends(part.mesh, limits);
}

BendMap bends_for_shop(const PartFile& part)
{
    BendLimits limits;
    const double sharp = limits.sharp;
    if (!is_stated(part)) {
        BendMap map = find_bends(part.mesh, limits);
        leave_out_smooth(part, map);
        return map;
    }
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

std::vector<std::array<EdgeUse, 2>> edges_of(const TriMesh& part, const BendMap& map, const Bend& fold)
{
    std::vector<std::array<EdgeUse, 2>> edges;
    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end != begin + 2)
            return;
        const EdgeUse &one = uses[begin], &other = uses[begin + 1];
        if (const auto [low, high] = std::minmax(map.label[one.face], map.label[other.face]);
            low == fold.a && high == fold.b)
            edges.push_back({one, other});
    });
    return edges;
}

bool is_within_a_face(const PartFile& part, const BendMap& map, size_t k)
{
    if (!part.cad || map.bends[k].faces == 0)
        return false;
    const auto cad_face = [&](int f) { return part.cad->face[size_t(part.source_face[size_t(f)])]; };
    const Eigen::VectorXd size = area_vectors(part.mesh).colwise().norm();
    const int label = int(map.regions.size() + k);
    std::map<int, double> of_bend, all; // mm2 times 2, by CAD face
    for (int f = 0; f < part.mesh.triangles(); ++f) {
        all[cad_face(f)] += size[f];
        if (map.label[f] == label)
            of_bend[cad_face(f)] += size[f];
    }
    const auto most = std::ranges::max_element(of_bend, {}, [](const auto& a) { return a.second; });
    constexpr double some = 0.1; // more than remeshing moves to a neighbour
    return most != of_bend.end() && all[most->first] - most->second > some * all[most->first];
}

} // namespace spia
