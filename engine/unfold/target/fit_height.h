#pragma once
#include <optional>
#include <vector>

#include "engine/unfold/target/fit_target.h"

namespace spia {

/// The smooth face through a region of the part that is seen whole along its mean normal: the
/// height over its mean plane with the least squares of the vertices' distances and a little of a
/// thin plate's bending energy, over the box around the region; from there it goes straight on. It
/// never folds back. [Duchon 1977 for the energy]
/// @param faces of the part, each once; they exist
/// @returns none if a face is steeper than 75 degrees against the mean plane, or more than 23
/// beside the smooth face: an edge or a
///          small feature is in the region
std::optional<TargetFit> fit_height(const TriMesh& part, const std::vector<int>& faces);

} // namespace spia
