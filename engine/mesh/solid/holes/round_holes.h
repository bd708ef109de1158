#pragma once
#include <vector>

#include "engine/mesh/solid/fit/round_edge.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A hole square through sheet, whose wall is a surface of revolution whatever is sunk at either
/// skin: cylinders, cones of any angle, floors.
struct RoundHole {
    RoundEdge mouth;         ///< where it begins: plane skin is all around it; its axis points
                             ///< outwards from the solid
    std::vector<int> wall;   ///< triangles, ascending
    std::vector<int> beyond; ///< triangles of the other skin beside the wall, ascending
    double far = 0;          ///< mm, radius of the wall where it meets that skin
    bool whole = true;       ///< it does so all around; else a bend, a border or another hole cuts
                             ///< it off, along convex edges
};

/// Found by shape alone, before it is known what is a skin: from circles in plane faces the wall is
/// followed over triangles that are chords of a surface of revolution about the axis, down to a
/// plane at the thickness that faces the other way. Pockets are none: what is around their floors
/// is no such surface, or has another axis.
/// @param normal  per triangle its area vector, outwards
/// @param thickness  mm, of the sheet, about
std::vector<RoundHole> round_holes(const TriMesh& solid, const Eigen::Matrix3Xd& normal, double thickness);

} // namespace spia
