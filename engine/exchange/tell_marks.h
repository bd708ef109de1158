#pragma once
#include <vector>

#include "engine/mesh/doctor.h"
#include "engine/mesh/sunk_holes.h"

namespace spia {

/// The note on holes that are wider at a skin: with place, diameter and depth of each.
/// @param holes  at least one
/// @param taken  the surface that is laid flat
/// @param source_face  per triangle of the solid its face in the file
Finding finding_of(const std::vector<SunkHole>& holes, Skin taken, const std::vector<int>& source_face);

} // namespace spia
