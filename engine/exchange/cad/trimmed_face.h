#pragma once
#include <TopoDS_Face.hxx>
#include <span>
#include <vector>

#include "engine/nurbs/trim.h"

namespace spia {

/// The surface as a face within its natural border, without the holes that the loops enclose. One
/// that was cut open comes back to itself: readers join the ends of both sides, and then the face
/// has no border that they understand. It is divided halfway, between the holes, into two faces.
/// For .cpp files of engine/exchange that hold an OcctSession.
/// @throws ExchangeError if OpenCASCADE makes no face of it, or none that its own check holds to be
/// valid
std::vector<TopoDS_Face> trimmed_faces(const NurbsSurface& surface, std::span<const TrimLoop> holes);

} // namespace spia
