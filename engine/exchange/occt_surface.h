#pragma once
#include <Geom_BSplineSurface.hxx>

#include "engine/nurbs/surface.h"

namespace spia {

/// @throws InputError unless counts, knots (clamped, not decreasing, no inner one more than degree times),
/// weights (> 0)
///         and points (finite) make a surface that CAD files can hold
void require_exchangeable(const NurbsSurface& surface);

/// For .cpp files of engine/exchange that hold an OcctSession; both copy poles and knots bit for bit.
Handle(Geom_BSplineSurface) to_occt(const NurbsSurface& surface);

/// A periodic surface is cut open at its first knot; a knot range other than 0 to 1 is mapped to it.
/// @throws InputError if the surface is not clamped
NurbsSurface from_occt(const Geom_BSplineSurface& surface);

} // namespace spia
