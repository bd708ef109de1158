#pragma once
#include <vector>

#include "engine/mesh/solid/stated_surface.h"
#include "engine/mesh/solid/thin_solid.h"

namespace spia {

/// A bend whose arcs on both skins have not one axis, or are not a thickness apart: the sheet is
/// not as thick there as elsewhere.
struct UnevenBend {
    double outer, inner; ///< mm, radii of the arcs on the outer and on the inner skin
    int face;            ///< a triangle of the solid on the outer one
};

/// In the order of their first triangles.
/// @param surface  per triangle of the solid, as the CAD file states it
std::vector<UnevenBend> uneven_bends(const ThinSolid& sheet, const std::vector<StatedSurface>& surface);

} // namespace spia
