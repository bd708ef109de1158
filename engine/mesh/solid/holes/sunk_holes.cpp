#include "engine/mesh/solid/holes/sunk_holes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "engine/mesh/edge_graph.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/solid/border/move_in_flats.h"
#include "engine/mesh/solid/fit/round_edge.h"
#include "engine/mesh/solid/holes/cut_off_holes.h"
#include "engine/mesh/solid/holes/hole_limits.h"
#include "engine/mesh/solid/holes/round_holes.h"
#include "engine/mesh/solid/holes/sheet_walls.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// The circle that an edge is on plane skin which lies around it, its axis outwards; none: it is
/// another thing.
std::optional<RoundEdge> circle_through(const TriMesh& solid, const Eigen::Matrix3Xd& normal, const WallEdge& edge,
                                        double thickness)
{
    constexpr double plane = 1 - 1e-6; // 0.1 degrees
    Eigen::Vector3d outwards = Eigen::Vector3d::Zero();
    double size = 0;
    for (const int f : edge.skin) {
        outwards += normal.col(f);
        size += normal.col(f).norm();
    }
    if (edge.skin.empty() || outwards.norm() < plane * size)
        return std::nullopt;
    const auto circle = round_edge(solid.position(Eigen::all, edge.vertex), outwards, same_in_hole * thickness);
    double beyond = 0; // of the sheet's own outline the skin is within
    for (const int f : edge.skin)
        if (circle)
            beyond += circle->off_axis(solid.position(Eigen::all, solid.triangle.col(f)).rowwise().mean()).norm() -
                      circle->radius;
    return beyond > 0 ? circle : std::nullopt;
}

std::optional<SunkHole> sunk(const TriMesh& solid, const Eigen::Matrix3Xd& normal, const SheetWall& wall,
                             SheetSide side, double thickness)
{
    const WallEdge& edge = wall.edge(side);
    const std::optional<RoundEdge> circle = circle_through(solid, normal, edge, thickness);
    if (!circle)
        return std::nullopt;
    double least = std::numeric_limits<double>::infinity();
    for (const int v : wall.vertex)
        least = std::min(least, circle->off_axis(solid.position.col(v)).norm());
    if (least > circle->radius - sunk_in_hole * thickness)
        return std::nullopt;
    double depth = std::numeric_limits<double>::infinity();
    std::vector<int> narrowest;
    for (const int v : wall.vertex)
        if (circle->off_axis(solid.position.col(v)).norm() <= least + same_in_hole * thickness) {
            depth = std::min(depth, -circle->height(solid.position.col(v)));
            narrowest.push_back(v);
        }
    if (!circle->surrounded(solid.position(Eigen::all, narrowest)))
        least = 0;
    double along = 0, size = 0;
    for (const int f : edge.wall) {
        along += std::abs(normal.col(f).dot(circle->axis));
        size += normal.col(f).norm();
    }
    constexpr double square = 0.1; // 6 degrees
    SunkHole hole{0,         side,  circle->centre,         -circle->axis,     2 * circle->radius,
                  2 * least, depth, along <= square * size, edge.wall.front(), wall.outer.vertex};
    const double off = sunk_in_hole * thickness;
    double floor = 0; // mm, of what is as wide as the circle
    for (const int v : wall.vertex) {
        const double radius = circle->off_axis(solid.position.col(v)).norm(),
                     down = -circle->height(solid.position.col(v));
        if (radius > circle->radius - off && down < depth + off)
            floor = std::max(floor, down);
        const double sloped = circle->radius - (circle->radius - least) * down / depth;
        hole.stepped |= !hole.counterbore && down < depth - off && std::abs(radius - sloped) > off;
    }
    hole.stepped |= hole.counterbore && floor < depth - off;
    return hole;
}

/// The vertices of a skin at which its border meets itself.
std::set<int> pinched_at(const TriMesh& solid, const ThinSolid& sheet, SheetSide side)
{
    std::map<int, int> edges;
    const std::vector<EdgeUse> uses = edge_uses(solid.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        const auto of_skin = std::count_if(uses.begin() + std::ptrdiff_t(begin), uses.begin() + std::ptrdiff_t(end),
                                           [&](const EdgeUse& use) { return sheet.side[size_t(use.face)] == side; });
        if (of_skin == 1)
            for (const int v : {uses[begin].low, uses[begin].high})
                ++edges[v];
    });
    std::set<int> pinched;
    for (const auto& [v, count] : edges)
        if (count > 2)
            pinched.insert(v);
    return pinched;
}

/// The circle as a closed row of points.
Eigen::Matrix3Xd circle_of(const SunkHole& hole, Skin surface, double thickness)
{
    constexpr int points = 120; // chords of 3 degrees, as round_border() has them
    const bool same = (surface == Skin::outer) == (hole.skin == SheetSide::outer);
    const double depth = surface == Skin::middle ? thickness / 2 : same ? 0 : thickness;
    const Eigen::Vector3d x = hole.inwards.unitOrthogonal(), y = hole.inwards.cross(x);
    Eigen::Matrix3Xd row(3, points + 1);
    for (int i = 0; i <= points; ++i) {
        const double angle = 2 * std::numbers::pi * (i % points) / points;
        row.col(i) =
            hole.centre + depth * hole.inwards + hole.diameter / 2 * (std::cos(angle) * x + std::sin(angle) * y);
    }
    return row;
}

} // namespace

std::vector<SunkHole> sunk_holes(const TriMesh& solid, const ThinSolid& sheet)
{
    const Eigen::Matrix3Xd normal = sheet.flipped * area_vectors(solid);
    const std::vector<RoundHole> round = round_holes(solid, normal, sheet.thickness);
    std::vector<char> cut_off(size_t(solid.triangles()), 0);
    for (const RoundHole& hole : round)
        for (const int f : hole.wall)
            cut_off[size_t(f)] = !hole.whole;
    std::vector<SunkHole> holes;
    int number = 0;
    const auto add = [&](SunkHole& hole) {
        hole.hole = number;
        holes.push_back(std::move(hole));
    };
    const std::array<std::set<int>, 2> pinched{pinched_at(solid, sheet, SheetSide::inner),
                                               pinched_at(solid, sheet, SheetSide::outer)};
    std::vector<std::vector<int>> others;
    for (SheetWall& wall : sheet_walls(solid, sheet)) {
        if (std::ranges::any_of(wall.face, [&](int f) { return cut_off[size_t(f)] != 0; }))
            continue;
        if (wall.outer.vertex.empty() || wall.inner.vertex.empty())
            continue; // not through the sheet
        const size_t before = holes.size();
        for (const SheetSide side : {SheetSide::outer, SheetSide::inner})
            if (auto hole = sunk(solid, normal, wall, side, sheet.thickness)) {
                const WallEdge& edge = wall.edge(side);
                hole->touching = std::ranges::any_of(
                    edge.vertex, [&](int v) { return pinched[side == SheetSide::outer].contains(v); });
                add(*hole);
            }
        if (holes.size() > before)
            ++number;
        else
            others.push_back(std::move(wall.face));
    }
    const CutOffHoles search(solid, normal, sheet);
    for (const RoundHole& hole : round)
        if (!hole.whole) {
            for (SunkHole& each : search.of(hole))
                add(each);
            ++number;
        }
    for (const std::vector<int>& wall : others) {
        for (SunkHole& each : search.over_bend(wall))
            add(each);
        ++number;
    }
    return holes;
}

int cut_off_at(const std::vector<SunkHole>& holes, SheetSide skin)
{
    return int(std::ranges::count_if(
        holes, [&](const SunkHole& hole) { return hole.cut_off && hole.diameter > 0 && hole.skin == skin; }));
}

int wider_at(const std::vector<SunkHole>& holes, SheetSide skin)
{
    return int(std::ranges::count(holes, skin, &SunkHole::skin));
}

std::set<int> sunk_in_bends(const std::vector<SunkHole>& holes)
{
    std::set<int> result;
    for (const SunkHole& hole : holes)
        if (hole.diameter == 0)
            result.insert(hole.hole);
    return result;
}

std::set<int> sunk_through(const std::vector<SunkHole>& holes, double thickness)
{
    constexpr double all = 1 - 1e-3; // of the thickness
    std::set<int> result;
    for (const SunkHole& hole : holes)
        if (hole.cut_off && hole.depth > all * thickness)
            result.insert(hole.hole);
    return result;
}

std::set<int> wider_in_middle(const std::vector<SunkHole>& holes, SheetSide from, double thickness)
{
    std::set<int> result = sunk_through(holes, thickness);
    for (const SunkHole& hole : holes)
        if (hole.diameter == 0 || (hole.cut_off && hole.skin == from))
            result.insert(hole.hole);
    return result;
}

ThinSolid sides_exchanged(const ThinSolid& sheet)
{
    ThinSolid result = sheet;
    for (SheetSide& side : result.side)
        side = side == SheetSide::outer   ? SheetSide::inner
               : side == SheetSide::inner ? SheetSide::outer
                                          : SheetSide::rim;
    std::swap(result.outer, result.inner);
    return result;
}

void straighten_holes(SkinMesh& middle, const TriMesh& solid, const std::vector<SunkHole>& holes, double thickness)
{
    for (const SunkHole& hole : holes)
        for (int v = 0; v < middle.mesh.vertices(); ++v)
            if (const int source = middle.source_vertex[size_t(v)];
                std::binary_search(hole.outer.begin(), hole.outer.end(), source))
                middle.mesh.position.col(v) = solid.position.col(source) +
                                              (hole.skin == SheetSide::outer ? 1 : -1) * thickness / 2 * hole.inwards;
    std::erase_if(middle.straightened, [&](const StraightVertex& vertex) { // belong there
        return std::ranges::any_of(
            holes, [&](const SunkHole& hole) { return std::ranges::binary_search(hole.outer, vertex.source_vertex); });
    });
}

std::vector<const SunkHole*> narrow_holes(SkinMesh& middle, const std::vector<SunkHole>& holes)
{
    constexpr double rounding = 1e-12;
    const auto pulls_border = [](const SunkHole& hole) { return hole.touching && hole.skin == SheetSide::outer; };
    // others may be called by one there
    const std::vector<char> on_rim = edge_graph(middle.mesh).on_rim;
    std::vector<FlatMove> moves;
    std::map<int, const SunkHole*> of_vertex;
    for (const SunkHole& hole : holes)
        for (int v = 0; v < middle.mesh.vertices() && hole.least > 0 && !pulls_border(hole); ++v) {
            if (!on_rim[size_t(v)] ||
                !std::binary_search(hole.outer.begin(), hole.outer.end(), middle.source_vertex[size_t(v)]))
                continue;
            const Eigen::Vector3d place = middle.mesh.position.col(v), way = place - hole.centre,
                                  out = way - way.dot(hole.inwards) * hole.inwards;
            const double share = hole.least / 2 / out.norm() - 1;
            if (std::abs(share) <= rounding)
                continue;
            moves.push_back({v, place + share * out, hole.inwards});
            of_vertex[v] = &hole;
        }
    std::set<const SunkHole*> kept; // of one vector: in its order
    for (const SunkHole& hole : holes)
        if (pulls_border(hole))
            kept.insert(&hole);
    for (const FlatMove& move : move_in_flats(middle, moves))
        kept.insert(of_vertex.at(move.vertex));
    return {kept.begin(), kept.end()};
}

std::vector<MarkLine> lines_of(const std::vector<SunkHole>& holes, Skin surface, double thickness)
{
    constexpr double same = 1e-3; // of the thickness
    std::vector<MarkLine> lines;
    const SunkHole* before = nullptr; // whose circle is the last line
    for (const SunkHole& hole : holes) {
        const MarkLabel label{hole.counterbore ? MarkLabel::Kind::counterbore : MarkLabel::Kind::countersink,
                              hole.skin == SheetSide::outer,
                              hole.skin == SheetSide::inner,
                              hole.diameter,
                              hole.stepped ? 0 : hole.depth,
                              hole.least};
        for (const MarkOutline& edge : hole.edge)
            lines.push_back({on_surface(edge, surface, thickness), label});
        // at the skin that is laid flat they are cut
        const bool cut = surface != Skin::middle && (surface == Skin::outer) == (hole.skin == SheetSide::outer);
        if (cut || hole.cut_off)
            continue;
        if (before && before->hole == hole.hole && std::abs(before->diameter - hole.diameter) < same * thickness) {
            MarkLabel& both = lines.back().label;
            both.outer = both.inner = true;
            if (before->counterbore != hole.counterbore || std::abs(before->depth - hole.depth) >= same * thickness)
                both.deep = 0;
            continue;
        }
        lines.push_back({circle_of(hole, surface, thickness), label});
        before = &hole;
    }
    return lines;
}

} // namespace spia
