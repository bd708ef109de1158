#pragma once
#include <TopoDS_Face.hxx>
#include <span>
#include <vector>

#include "engine/mesh/solid/stated_surface.h"

namespace spia {

/// Per face the plane or the cylinder that it lies on, mm. Splines and swept surfaces that are one
/// (as IGES files have them) are found to be. For .cpp files of engine/exchange that hold an
/// OcctSession.
std::vector<StatedSurface> stated_surfaces(std::span<const TopoDS_Face> faces);

} // namespace spia
