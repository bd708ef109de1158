#pragma once
#include <vector>

#include "engine/mesh/solid/holes/sunk_holes.h"

namespace spia {

/// A countersink or a counterbore that has no whole circle at either skin: it is open to a border,
/// runs into another hole or a bend, and is none of the sunk_holes().
struct OpenSink {
    int face;                 ///< of its wall, a triangle of the solid
    Eigen::Vector3d place;    ///< mm, in the middle of the wall
    SheetSide skin;           ///< at which it is wider
    bool land;                ///< a straight wall is below it; else it goes through the sheet
    bool counterbore = false; ///< it has a floor
};

/// Found by walls across the sheet that lean at one angle, turn around an axis and face it, and by
/// the open_counterbores(). In the order of their first triangles, counterbores last.
/// @param told  those that are known
std::vector<OpenSink> open_sinks(const TriMesh& solid, const ThinSolid& sheet, const std::vector<SunkHole>& told);

} // namespace spia
