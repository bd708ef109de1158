#pragma once
#include <optional>

#include "engine/core/progress.h"
#include "engine/part/part_file.h"

namespace spia {

/// Of a part that unrolls needles say nothing of its strains: a note takes the place of the
/// finding.
PartFile excuse_needles(PartFile part);

/// Needles on CAD faces. On a part that unrolls they are strips along its straight lines, as they
/// should be. On others they are chords that differ from triangle to triangle, which is taken for
/// strain: they go unasked, or a note says why not.
/// @param deflection  mm, of the triangles from the CAD faces, if it was asked for
PartFile remesh_needles(PartFile part, std::optional<double> deflection, const Progress& progress);

} // namespace spia
