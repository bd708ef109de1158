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
/// surface, and none beyond. Where a wall crosses the sheet askew, the border is halfway along the
/// wall. Cusps, where two borders touch, are not judged. In the order of the boundary
/// loops.
/// @param thickness  mm
/// @param tolerance  mm; what is nearer to its place is not told
/// @param deflection  mm, how far facets of the solid may be from the arcs that they stand for
std::vector<BesideSolid> beside_solid(const TriMesh& middle, const TriMesh& solid, double thickness, double tolerance,
                                      double deflection = 0);

/// A boundary loop and how far it is beside the border of the solid.
struct BesideLoop {
    std::vector<int> vertex;    ///< as boundary_loops() has them
    std::vector<double> beside; ///< mm, as BesideSolid has it; of each vertex, and then of the
                                ///< edge from it to the next: in its middle, else near an end;
                                ///< 0: it is not
};

/// The same of every vertex and edge.
std::vector<BesideLoop> beside_loops(const TriMesh& middle, const TriMesh& solid, double thickness, double tolerance,
                                     double deflection = 0);

} // namespace spia
