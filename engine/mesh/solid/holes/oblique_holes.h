#pragma once
#include <vector>

#include "engine/mesh/solid/thin_solid.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A hole whose wall crosses a flat askew: its edges at both skins are alike and lie beside each
/// other.
struct ObliqueHole {
    std::vector<int> rim; ///< vertices of the solid at the outer skin, ascending
    Eigen::Vector3d way;  ///< mm, from each of them along the wall to the middle of the sheet
};

/// Its direction is that of the stated cylinder, else it leads from the vertices of one edge to
/// those of the other, or from the middle of the one to that of the other.
/// @param surface  per face of the solid; empty: none is stated
std::vector<ObliqueHole> oblique_holes(const TriMesh& solid, const ThinSolid& sheet,
                                       const std::vector<StatedSurface>& surface);

} // namespace spia
