#pragma once
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {

/// One patch or patches around the holes, and the cuts between them.
void patches_editor(Frame& frame);

/// What the colours of the surface say.
/// @returns whether it was changed, in `look`
bool surface_look_combo(SurfaceLook& look);

/// The lattice around the surface and the picked handles: how it is deformed.
void shape_editor(Frame& frame);

/// Control points, deviation, and how fit the surface is for analysis.
void surface_rows(Frame& frame, const SurfaceStage& surface);

} // namespace spia::viewer
