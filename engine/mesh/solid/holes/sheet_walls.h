#pragma once
#include <map>
#include <vector>

#include "engine/mesh/solid/thin_solid.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Where a wall meets one skin.
struct WallEdge {
    std::vector<int> vertex; ///< of the solid, ascending
    std::map<int, int> next; ///< per vertex the one after it, in the order of the wall
    std::vector<int> skin;   ///< triangles of the skin
    std::vector<int> wall;   ///< triangles across the thickness
};

/// All faces across the thickness that hang together.
struct SheetWall {
    std::vector<int> face;   ///< ascending
    std::vector<int> vertex; ///< of the solid, ascending
    WallEdge outer, inner;

    const WallEdge& edge(SheetSide side) const { return side == SheetSide::outer ? outer : inner; }
};

/// In the order of their first triangles.
std::vector<SheetWall> sheet_walls(const TriMesh& solid, const ThinSolid& sheet);

} // namespace spia
