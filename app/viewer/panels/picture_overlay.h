#pragma once
#include "app/viewer/panels/ui.h"

namespace spia::viewer {

/// Draws legend and labels of a scene over a view that fills a rectangle, as on the screen.
void draw_overlay(Frame& frame, View view, const Scene& scene, ImVec2 from, ImVec2 size, bool legend, bool labels,
                  ImDrawList* draw);

} // namespace spia::viewer
