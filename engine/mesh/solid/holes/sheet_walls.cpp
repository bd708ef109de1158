#include "engine/mesh/solid/holes/sheet_walls.h"

#include <algorithm>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"

namespace spia {
namespace {

void make_set(std::vector<int>& values)
{
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

} // namespace

std::vector<SheetWall> sheet_walls(const TriMesh& solid, const ThinSolid& sheet)
{
    const auto rim = [&](int f) { return sheet.side[size_t(f)] == SheetSide::rim; };
    const std::vector<EdgeUse> uses = edge_uses(solid.triangle);
    DisjointSets together(size_t(solid.triangles()));
    const auto each_edge = [&](const auto& visit) {
        for_each_edge(uses, [&](size_t begin, size_t end) {
            if (end == begin + 2)
                visit(uses[begin], uses[begin + 1]);
        });
    };
    each_edge([&](const EdgeUse& a, const EdgeUse& b) {
        if (rim(a.face) && rim(b.face))
            together.join(a.face, b.face);
    });
    std::map<int, size_t> number;
    std::vector<SheetWall> walls;
    for (int f = 0; f < solid.triangles(); ++f) {
        if (!rim(f))
            continue;
        const auto [at, added] = number.try_emplace(together.root(f), walls.size());
        if (added)
            walls.emplace_back();
        walls[at->second].face.push_back(f);
        for (const int v : solid.triangle.col(f))
            walls[at->second].vertex.push_back(v);
    }
    each_edge([&](const EdgeUse& a, const EdgeUse& b) {
        if (rim(a.face) == rim(b.face))
            return;
        const EdgeUse &wall = rim(a.face) ? a : b, &skin = rim(a.face) ? b : a;
        SheetWall& found = walls[number.at(together.root(wall.face))];
        WallEdge& edge = sheet.side[size_t(skin.face)] == SheetSide::outer ? found.outer : found.inner;
        edge.vertex.insert(edge.vertex.end(), {wall.low, wall.high});
        edge.next[wall.forward ? wall.low : wall.high] = wall.forward ? wall.high : wall.low;
        edge.skin.push_back(skin.face);
        edge.wall.push_back(wall.face);
    });
    for (SheetWall& wall : walls)
        for (std::vector<int>* values : {&wall.vertex, &wall.outer.vertex, &wall.inner.vertex})
            make_set(*values);
    return walls;
}

} // namespace spia
