#pragma once
#include "engine/part/part_file.h"
#include "engine/unfold/plan/bends.h"

namespace spia {

/// The bends that a shop is told of. Where a CAD file states that all faces are planes and
/// cylinders, an edge between two planes is a fold, however little it turns, if the planes turn by
/// as much: triangles that a rim tilts do not. Of other parts it may be an edge between chords.
BendMap bends_for_shop(const PartFile& part);

} // namespace spia
