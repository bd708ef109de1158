#include "engine/mesh/solid/marks/mark_outlines.h"

#include <map>
#include <utility>

#include "engine/mesh/closest_point.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Which triangles of marks have left the skin: all but islands, which are floors that lie in it
/// once the marks are put back.
class Sunken {
public:
    Sunken(const TriMesh& solid, const ThinSolid& sheet, const PlainSolid& plain)
        : sunken_(size_t(solid.triangles()), 0)
    {
        std::vector<char> floor(size_t(solid.triangles()), 0);
        for (const SheetMark& mark : sheet.marks) {
            for (const int f : mark.wall)
                sunken_[size_t(f)] = 1;
            for (const int f : mark.floor)
                floor[size_t(f)] = 1;
        }
        DisjointSets floors(floor.size());
        const std::vector<EdgeUse> uses = edge_uses(solid.triangle);
        for_each_edge(uses, [&](size_t begin, size_t end) {
            if (end == begin + 2 && floor[size_t(uses[begin].face)] && floor[size_t(uses[begin + 1].face)])
                floors.join(uses[begin].face, uses[begin + 1].face);
        });
        constexpr double same_level = 1e-3; // of the thickness, as without_marks() has it
        const ClosestPointSearch skin(plain.mesh);
        std::vector<char> off(floor.size(), 0); // by root
        for (int f = 0; f < solid.triangles(); ++f)
            for (int k = 0; k < 3 && floor[size_t(f)] && !off[size_t(floors.root(f))]; ++k)
                off[size_t(floors.root(f))] =
                    skin.nearest(solid.position.col(solid.triangle(k, f))).distance > same_level * sheet.thickness;
        for (int f = 0; f < solid.triangles(); ++f)
            if (floor[size_t(f)])
                sunken_[size_t(f)] = off[size_t(floors.root(f))];
    }
    bool operator()(int f) const { return sunken_[size_t(f)] != 0; }

private:
    std::vector<char> sunken_; ///< per triangle
};

/// Rows of vertices along directed edges; a closed one ends with its first.
std::vector<std::vector<int>> rows_of(std::multimap<int, int>& next)
{
    std::map<int, int> into;
    for (const auto& [from, to] : next)
        ++into[to];
    std::vector<std::vector<int>> rows;
    const auto follow = [&](int start) {
        std::vector<int> row{start};
        for (auto way = next.find(start); way != next.end(); way = next.find(row.back())) {
            row.push_back(way->second);
            next.erase(way);
            if (row.back() == start)
                break;
        }
        rows.push_back(std::move(row));
    };
    std::vector<int> open;
    for (auto at = next.begin(); at != next.end(); at = next.upper_bound(at->first))
        if (int(next.count(at->first)) > into[at->first])
            open.push_back(at->first);
    for (const int start : open)
        follow(start);
    while (!next.empty())
        follow(next.begin()->first);
    return rows;
}

} // namespace

std::vector<MarkOutline> outlines_along(std::multimap<int, int> next, SheetSide skin, const TriMesh& solid,
                                        const Eigen::Matrix3Xd& normal, const std::function<bool(int)>& on_skin)
{
    std::map<int, Eigen::Vector3d> inwards;
    for (const auto& [from, to] : next)
        inwards[from] = inwards[to] = Eigen::Vector3d::Zero();
    for (int f = 0; f < solid.triangles(); ++f)
        for (int k = 0; k < 3 && on_skin(f); ++k)
            if (const auto at = inwards.find(solid.triangle(k, f)); at != inwards.end())
                at->second -= normal.col(f);
    std::vector<MarkOutline> outlines;
    for (const std::vector<int>& row : rows_of(next)) {
        MarkOutline outline{skin, solid.position(Eigen::all, row), Eigen::Matrix3Xd(3, Eigen::Index(row.size()))};
        for (size_t k = 0; k < row.size(); ++k)
            outline.inwards.col(Eigen::Index(k)) = inwards.at(row[k]).normalized();
        outlines.push_back(std::move(outline));
    }
    return outlines;
}

std::vector<MarkOutline> mark_outlines(const TriMesh& solid, const ThinSolid& sheet, const PlainSolid& plain)
{
    const Sunken sunken(solid, sheet, plain);
    const Eigen::Matrix3Xd normal = sheet.flipped * area_vectors(solid);
    const std::vector<EdgeUse> uses = edge_uses(solid.triangle);
    std::vector<MarkOutline> outlines;
    for (const SheetSide skin : {SheetSide::outer, SheetSide::inner}) {
        std::multimap<int, int> next;
        for_each_edge(uses, [&](size_t begin, size_t end) {
            if (end != begin + 2)
                return;
            const EdgeUse &a = uses[begin], &b = uses[begin + 1];
            const bool on_skin = sheet.side[size_t(a.face)] == skin && sheet.side[size_t(b.face)] == skin;
            if (!on_skin || sunken(a.face) == sunken(b.face))
                return;
            const EdgeUse& level = sunken(a.face) ? b : a;
            next.emplace(level.forward ? level.low : level.high, level.forward ? level.high : level.low);
        });
        const auto level = [&](int f) { return !sunken(f) && sheet.side[size_t(f)] == skin; };
        for (MarkOutline& outline : outlines_along(std::move(next), skin, solid, normal, level))
            outlines.push_back(std::move(outline));
    }
    return outlines;
}

Eigen::Matrix3Xd on_surface(const MarkOutline& outline, Skin surface, double thickness)
{
    const bool same = (surface == Skin::outer) == (outline.skin == SheetSide::outer);
    const double depth = surface == Skin::middle ? thickness / 2 : same ? 0 : thickness;
    return outline.point + depth * outline.inwards;
}

} // namespace spia
