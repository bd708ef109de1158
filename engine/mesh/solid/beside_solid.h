#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A row of neighbouring vertices and edges of a middle surface's border that is not at the border
/// of its solid.
struct BesideSolid {
    Eigen::Vector3d place; ///< mm, of what is farthest from it
    double beside;         ///< mm along the surface; > 0: the solid goes on, < 0: it ends before.
                           ///< 8 thicknesses at most
};

/// Holds a middle surface against the solid that it was made of, by nothing but lines square to it
/// through half the thickness on both sides: at the border they meet matter on the side of the
/// surface, and none beyond. Where a wall crosses the sheet askew, the border may also be halfway
/// along the wall. Cusps, where two borders touch, are not judged. In the order of the boundary
/// loops.
/// @param thickness  mm
/// @param tolerance  mm; what is nearer to its place is not told
std::vector<BesideSolid> beside_solid(const TriMesh& middle, const TriMesh& solid, double thickness, double tolerance);

} // namespace spia
