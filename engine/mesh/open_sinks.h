#pragma once
#include <vector>

#include "engine/mesh/sunk_holes.h"

namespace spia {

/// A countersink in flat sheet that has no whole circle at either skin: it is open to a border or
/// runs into another hole, and is none of the sunk_holes().
struct OpenSink {
    int face;              ///< of its wall, a triangle of the solid
    Eigen::Vector3d place; ///< mm, in the middle of the wall
    bool land;             ///< a straight wall is below it; else it goes through the sheet
};

/// Found by walls across the sheet that lean at one angle, turn around an axis and face it. In the
/// order of their first triangles.
/// @param told  those that are known
std::vector<OpenSink> open_sinks(const TriMesh& solid, const ThinSolid& sheet, const std::vector<SunkHole>& told);

} // namespace spia
