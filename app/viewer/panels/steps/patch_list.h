#pragma once
#include "app/viewer/panels/widgets.h"
#include "engine/pipeline/session.h"

namespace spia::viewer {

/// The patches with what each is worth, those first that are worst by the column that was clicked.
/// A click on one shows where that is.
void patch_list(Frame& frame, const SurfaceStage& surface, const Certificate& certificate);

} // namespace spia::viewer
