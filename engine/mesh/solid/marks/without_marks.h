#pragma once
#include <vector>

#include "engine/mesh/solid/marks/sheet_marks.h"
#include "engine/mesh/solid/stated_surface.h"

namespace spia {

/// The same with what CAD states of each triangle: so skins are closed exactly over marks in bends
/// and over those that reach from a bend into the flat.
/// @param surface  per triangle of the solid; empty: nothing is stated
PlainSolid without_marks(const TriMesh& solid, const ThinSolid& sheet, const std::vector<StatedSurface>& surface);

} // namespace spia
