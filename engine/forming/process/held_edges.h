#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// An edge of the part's outer outline that a restraint of the edge holds.
struct HeldEdge {
    int from, to; ///< vertices, in the order of the outline
    int face;     ///< on it
};

/// The outer outline without the edges on which the other side of a seam lies: these are no edge of
/// the part.
std::vector<HeldEdge> held_edges(const TriMesh& part);

} // namespace spia
