#pragma once
#include "app/viewer/panels/ui.h"

namespace spia::viewer {

inline glm::dvec2 dvec(ImVec2 v) { return {v.x, v.y}; }

/// The mouse as a view sees it. Pixels from the view's upper left corner.
struct Mouse {
    glm::dvec2 pixel, size;
    bool inside;
};

/// What the chosen tool does with the mouse in a view.
/// @param from  upper left corner of the view in the window, pixels
void use_tool(Frame& frame, View view, const Mouse& mouse, ImVec2 from, ImDrawList* draw);

/// Small buttons at the right end of a view's title; a narrow view keeps those that matter most.
void view_buttons(Frame& frame, View view);

} // namespace spia::viewer
