#pragma once
#include <vector>

#include "engine/unfold/step/freed_piece.h"
#include "engine/unfold/target/fit_target.h"

namespace spia {

/// How well a target goes on from the fixed faces where freed ones are joined to them: its greatest
/// distance from the held vertices, and the greatest angle between its normals and those of the
/// fixed faces along the edges that they share with freed ones, less what is only the chord of a
/// bend: half of what the fixed faces around a held vertex turn from one to the next. A fixed face
/// that only touches the end of the hinge, as that of another bend does, may stand at any angle.
/// @param state the part as it is before the step
/// @param fixed ascending
/// @throws InputError if a held vertex is farther beside the target than 1e-3 of the part; names a
/// fixed face there
TargetFit hinge_quality(const TargetSurface& face, const TriMesh& state, const std::vector<int>& fixed,
                        const std::vector<FreedPiece>& pieces);

} // namespace spia
