#pragma once
#include <vector>

#include "engine/mesh/doctor/doctor.h"
#include "engine/mesh/solid/holes/sunk_holes.h"
#include "engine/mesh/solid/skin.h"

namespace spia {

const char* of_skin(SheetSide side); ///< "inner", "outer"

/// The note on shallow marks that are passed over: with place, skin and depth of each.
/// @param marks  at least one
/// @param sheet  the solid that they are on
/// @param source_face  per triangle of the solid its face in the file
Finding finding_of(const std::vector<SheetMark>& marks, const ThinSolid& sheet, const std::vector<int>& source_face);

/// The note on holes that are wider at a skin: with place, diameter and depth of each.
/// @param holes  at least one
/// @param taken  the surface that is laid flat
/// @param side  the skin whose triangles it has
/// @param thickness  mm
/// @param source_face  as above
Finding finding_of(const std::vector<SunkHole>& holes, Skin taken, SheetSide side, double thickness,
                   const std::vector<int>& source_face);

} // namespace spia
