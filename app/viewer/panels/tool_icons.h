#pragma once
#include <imgui.h>

#include "app/viewer/model/document/state.h"

namespace spia::viewer {

/// The sign of a tool, drawn in lines: as sharp at any scale of the screen.
/// @param from  upper left corner of its square; @param size  pixels, of the square's side
void draw_tool_icon(ImDrawList* draw, Tool tool, ImVec2 from, float size, ImU32 ink, ImU32 accent);

} // namespace spia::viewer
