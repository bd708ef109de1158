#include "engine/mesh/solid/bends/bend_holes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "engine/mesh/solid/off_axis.h"

namespace spia {
namespace {

using Kind = StatedSurface::Kind;

/// The closed borders of the bend and its flats, vertices one after the other.
std::vector<std::vector<int>> border_loops(const MiddleOfSolid& part, const UnrolledBend& bend)
{
    std::map<int, std::vector<int>> next;
    const std::vector<EdgeUse> uses = edge_uses(part.middle.mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        const EdgeUse& use = uses[begin];
        if (end == begin + 1 && bend.on[size_t(use.face)]) {
            next[use.low].push_back(use.high);
            next[use.high].push_back(use.low);
        }
    });
    std::vector<std::vector<int>> loops;
    std::set<int> seen;
    for (const auto& [start, _] : next) {
        if (seen.contains(start))
            continue;
        std::vector<int> loop;
        bool whole = true;
        for (int v = start, before = -1; seen.insert(v).second;) {
            loop.push_back(v);
            whole &= next[v].size() == 2;
            const int to = next[v].size() == 2 && next[v][0] == before ? next[v][1] : next[v][0];
            before = std::exchange(v, to);
        }
        if (whole && loop.size() > 2)
            loops.push_back(std::move(loop));
    }
    return loops;
}

/// The triangles of the solid across the rim; some narrow ones of a mesh count to a skin.
std::vector<int> across(const MiddleOfSolid& part, const std::vector<int>& loop)
{
    const auto source = [&](size_t i) { return part.middle.source_vertex[size_t(loop[i % loop.size()])]; };
    std::vector<int> result;
    for (size_t i = 0; i < loop.size(); ++i) {
        const auto [low, high] = edge_key(source(i), source(i + 1));
        auto use =
            std::lower_bound(part.uses.begin(), part.uses.end(), std::pair(low, high),
                             [](const EdgeUse& u, const auto& wanted) { return std::pair(u.low, u.high) < wanted; });
        for (; use != part.uses.end() && use->low == low && use->high == high; ++use)
            if (part.sheet.side[size_t(use->face)] == SheetSide::rim)
                result.push_back(use->face);
    }
    return result;
}

/// The cylinder that triangles across a rim lie on.
std::optional<StatedSurface> wall_of(const MiddleOfSolid& part, const std::vector<int>& rim)
{
    if (rim.empty())
        return std::nullopt;
    if (const StatedSurface& first = part.surface[size_t(rim.front())]; first.kind == Kind::cylinder)
        return std::ranges::all_of(rim, [&](int f) { return same_cylinder(part.surface[size_t(f)], first); })
                   ? std::optional(first)
                   : std::nullopt;
    std::set<int> vertices;
    for (const int f : rim)
        for (const int v : part.solid.triangle.col(f))
            vertices.insert(v);
    const std::vector<int> places(vertices.begin(), vertices.end());
    return cylinder_through(part.solid.position(Eigen::all, places), part.normal(Eigen::all, rim), part.within);
}

/// Whether a loop goes around the wall, on it, rather than along a notch with a round end.
bool goes_around(const MiddleOfSolid& part, const StatedSurface& wall, const std::vector<int>& loop, size_t triangles)
{
    constexpr double few = 0.25;
    if (double(triangles) < (1 - few) * double(loop.size()) || std::ranges::any_of(loop, [&](int v) {
            return std::abs(off_axis(wall, part.outer(v)).norm() - wall.radius) > part.within;
        }))
        return false;
    double turns = 0;
    for (size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector3d a = off_axis(wall, part.outer(loop[i])),
                              b = off_axis(wall, part.outer(loop[(i + 1) % loop.size()]));
        turns += std::atan2(a.cross(b).dot(wall.direction), a.dot(b));
    }
    return std::abs(turns) >= std::numbers::pi;
}

/// The hole of a border. Nothing if it is none over the bend, or is where it belongs.
std::optional<BendHole> hole_of(const MiddleOfSolid& part, const UnrolledBend& bend, const std::vector<int>& loop)
{
    std::vector<int> rim = across(part, loop);
    const auto wall = wall_of(part, rim);
    const auto touches = [&](const EdgeKey& edge) {
        return std::ranges::find(loop, edge.first) != loop.end() || std::ranges::find(loop, edge.second) != loop.end();
    };
    if (!wall || std::ranges::any_of(bend.fixed, touches) || !goes_around(part, *wall, loop, rim.size()))
        return std::nullopt;
    constexpr double share = 0.005; // of the thickness; nearer the rim was met well enough
    const double off_by = share * part.sheet.thickness;
    BendHole hole{*wall, loop, {}, std::move(rim)};
    bool elsewhere = false, over = false;
    for (const int v : loop) {
        const auto place = where_wall_meets(part, bend, *wall, part.outer(v));
        if (!place)
            return std::nullopt;
        const Eigen::Vector2d &now = bend.now[size_t(v)], &below = bend.triangles.at[size_t(v)];
        hole.to.push_back(*place);
        elsewhere |= !((*place - now).norm() <= off_by);
        over |= bend.skin.zone(place->x()) == 0 || bend.skin.zone(below.x()) == 0;
    }
    return elsewhere && over ? std::optional(std::move(hole)) : std::nullopt;
}

} // namespace

std::vector<BendHole> bend_holes(const MiddleOfSolid& part, const UnrolledBend& bend)
{
    std::vector<BendHole> holes;
    for (const std::vector<int>& loop : border_loops(part, bend))
        if (auto hole = hole_of(part, bend, loop))
            holes.push_back(std::move(*hole));
    return holes;
}

std::optional<Eigen::Vector2d> where_wall_meets(const MiddleOfSolid& part, const UnrolledBend& bend,
                                                const StatedSurface& wall, const Eigen::Vector3d& place)
{
    const StatedSurface& cylinder = bend.cylinder;
    const Eigen::Vector3d &d = wall.direction, u = off_axis(cylinder, place),
                          w = d - d.dot(cylinder.direction) * cylinder.direction;
    std::vector<double> ways;
    for (const StatedSurface& p : bend.flat)
        ways.push_back((p.point - place).dot(p.direction) / d.dot(p.direction));
    const double a = w.squaredNorm(), b = u.dot(w), c = u.squaredNorm() - cylinder.radius * cylinder.radius;
    if (b * b >= a * c && a > 0)
        for (const double root : {-1., 1.})
            ways.push_back((-b + root * std::sqrt(b * b - a * c)) / a);
    constexpr double most = 3; // thicknesses
    double best = most * part.sheet.thickness;
    std::optional<Eigen::Vector2d> result;
    for (const double way : ways) {
        const Eigen::Vector3d to = place + way * d;
        if (!(std::abs(way) < best))
            continue;
        if (const auto flat = bend.skin.flat(to); flat && (bend.skin.in_space(*flat) - to).norm() <= part.within) {
            best = std::abs(way);
            result = flat;
        }
    }
    return result;
}

} // namespace spia
