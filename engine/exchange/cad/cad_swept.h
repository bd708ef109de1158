#pragma once
#include <TopoDS_Face.hxx>
#include <span>
#include <vector>

namespace spia {

/// The same faces; where a surface of revolution or extrusion is a cylinder or a cone, it is one of
/// that kind, with the same parameters. IGES has no others, and only of the elementary kinds the
/// triangles run along the straight lines on them, so that a bend is one that unrolls. For .cpp
/// files of engine/exchange that hold an OcctSession.
std::vector<TopoDS_Face> without_swept_cylinders(std::span<const TopoDS_Face> faces);

} // namespace spia
