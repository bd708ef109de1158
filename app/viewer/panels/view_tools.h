#pragma once
#include "app/viewer/panels/ui.h"

namespace spia::viewer {

inline glm::dvec2 dvec(ImVec2 v) { return {v.x, v.y}; }

/// The mouse as a view sees it. Pixels from the view's upper left corner.
struct Mouse {
    glm::dvec2 pixel, size;
    bool inside;
};

/// Gives a view a camera, and with it all cameras that turn together with this one.
void take_camera(ViewSettings& settings, View view, const Camera& camera);

/// What the chosen tool does with the mouse in a view.
/// @param from  upper left corner of the view in the window, pixels
void use_tool(Frame& frame, View view, const Mouse& mouse, ImVec2 from, ImDrawList* draw);

/// Whether a click is all that a tool needs.
bool tool_clicks(Tool tool);
/// What a click with such a tool does at a pixel of a view.
void click_with_tool(Frame& frame, View view, glm::dvec2 pixel, glm::dvec2 size);

/// Small buttons at the right end of a view's title; a narrow view keeps those that matter most.
void view_buttons(Frame& frame, View view);

} // namespace spia::viewer
