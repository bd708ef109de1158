#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/solid/thin_solid.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A hole into one skin that does not reach the other.
struct BlindHole {
    Eigen::Vector3d place; ///< mm, of its edge
    double depth;          ///< mm, square to the skin around it
};

/// By their first triangle. Shallow ones are marks, and none of these.
/// @param solid  without its marks
std::vector<BlindHole> blind_holes(const TriMesh& solid, const ThinSolid& sheet);

} // namespace spia
