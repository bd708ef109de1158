#pragma once
#include "engine/forming/flatten.h"
#include "engine/unfold/step/unfold_script.h"

namespace spia {

/// The blank that a part's steps gave in the form of flatten()'s: the fields are those of the last
/// state, the stamping direction is the normal of the plane in which it lies. The report tells of
/// the steps: `system` is the poorest of theirs, the trusted strain and `process_share` (of their
/// friction) the least; there are no iterations of its own, and `report.start` means nothing.
/// @param run     of this part
/// @param options those of the run; its tools are not in the steps
/// @throws InputError if the run gave no blank, or one with flipped triangles, or was that of
/// another part
FlattenResult stepped_blank(const TriMesh& part, const UnfoldRun& run, const FlattenOptions& options);

} // namespace spia
