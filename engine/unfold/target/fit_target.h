#pragma once
#include <optional>
#include <vector>

#include "engine/mesh/tri_mesh.h"
#include "engine/unfold/target/target_surface.h"

namespace spia {

/// A face through a region of the part, and how well it goes through.
struct TargetFit {
    TargetSurface face;
    double distance_mm; ///< greatest of the region's vertices
    double angle;       ///< radians, greatest between its faces' normals and the face's at their
                        ///< corners
};

/// The simplest of plane, cylinder and cone on which the vertices of a region lie, to a share of
/// the region's size.
/// @param faces     of the part, each once
/// @param tolerance of the distance, a share of the region's diagonal
/// @returns none if the region is no such face
/// @throws InputError if there are no faces, or one does not exist
std::optional<TargetFit> fit_target(const TriMesh& part, const std::vector<int>& faces, double tolerance = 1e-4);

} // namespace spia
