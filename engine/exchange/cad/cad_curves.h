#pragma once
#include <TopoDS_Edge.hxx>

#include "engine/mesh/solid/stated_curve.h"

namespace spia {

/// The line or the circle that an edge lies on, mm. Splines that are one (as some programs write
/// arcs) are found to be. For .cpp files of engine/exchange that hold an OcctSession.
StatedCurve stated_curve(const TopoDS_Edge& edge);

} // namespace spia
