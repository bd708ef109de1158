#pragma once
#include <optional>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// How far sheet that was laid on a target reaches beyond the faces that carry it.
struct TargetReach {
    double farthest_mm = 0; ///< straight, of the laid vertices from the nearest carrying face
    int without_room = 0;   ///< laid faces with a vertex farther than the target goes on: its
                            ///< extent
};

/// @param now       the part after the step
/// @param carrying  faces, at least one; @param laid faces
/// @param extent_mm how far the target goes on beyond the carrying faces; none: as far as the sheet
/// does
TargetReach target_reach(const TriMesh& now, const std::vector<int>& carrying, const std::vector<int>& laid,
                         const std::optional<double>& extent_mm);

} // namespace spia
