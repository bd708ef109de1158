#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/flat/outline.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Where a flat layout lies on itself. A sheet without handles whose triangles are all
/// counter-clockwise covers the plane at most once exactly if both lists are empty: a point is
/// covered as often as the outlines wind around it, and loops that neither cross nor wind locally
/// wind once at most.
struct Overlap {
    std::vector<OutlineCrossing> crossings; ///< pairs of edges of the outline that meet
    std::vector<int> wound;                 ///< vertices whose faces go around them more than once

    bool none() const { return crossings.empty() && wound.empty(); }
};

/// @param flat 2 by #V, without flipped triangles
/// @returns exact answers (orient2d.h) about what lies on itself by more than rounding, 1e-6 of the
/// layout's size
Overlap overlap(const TriMesh& part, const Eigen::Matrix2Xd& flat);

} // namespace spia
