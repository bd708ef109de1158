#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/tri_mesh.h"
#include "engine/unfold/target/target_surface.h"

namespace spia {

/// Where sheet that lies on a target lies on itself: landed faces on each other or on faces that
/// were there before.
struct LandedOverlap {
    int places = 0; ///< pairs of edges of the outlines that meet, vertices whose faces go around
                    ///< them more than once, and pieces that lie within another
    Eigen::Vector3d first = Eigen::Vector3d::Zero(); ///< mm, one of them; zero where there is none
    int landed = 0; ///< of these places, those of faces that were moved there; the others were
                    ///< there before
};

/// Judged exactly in the development of the target (overlap.h) over all faces that lie on it with
/// their outer side outside; each triangle is straight there. On a round target that sheet covers
/// all around, faces across the line of the development's cut are left out.
/// @param now       the part in a state
/// @param within_mm how far beside the target a vertex may be that lies on it
/// @param moved     faces that the step has laid there
LandedOverlap landed_overlap(const TriMesh& now, const TargetSurface& target, double within_mm,
                             const std::vector<int>& moved = {});

} // namespace spia
