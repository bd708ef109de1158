#pragma once
#include <TopoDS_Face.hxx>
#include <span>

#include "engine/nurbs/trim.h"

namespace spia {

/// The surface as a face within its natural border, without the holes that the loops enclose. For
/// .cpp files of engine/exchange that hold an OcctSession.
/// @throws ExchangeError if OpenCASCADE makes no face of it, or none that its own check holds to be
/// valid
TopoDS_Face trimmed_face(const NurbsSurface& surface, std::span<const TrimLoop> holes);

} // namespace spia
