#pragma once
#include "engine/part/part_file.h"

namespace spia {

/// How far a part is from one that unrolls: the sum of what angles at its vertices lack of a full
/// turn, or have too much, radians. Vertices within planes and cylinders of a CAD file, and where
/// these go over into each other smoothly, count for nothing: triangles of a bend that do not lie
/// along its straight lines have such angles, and the bend unrolls.
double curvature_off_bends(const PartFile& part);

} // namespace spia
