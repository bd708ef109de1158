#pragma once
#include "app/viewer/panels/ui.h"

namespace spia::viewer {

inline glm::dvec2 dvec(ImVec2 v) { return {v.x, v.y}; }

/// The mouse as a view sees it. Pixels from the view's upper left corner.
struct Mouse {
    glm::dvec2 pixel, size;
    bool inside;
};

inline constexpr float click_slack = 3; ///< pixels at content scale 1 that a hand moves in a click

/// Buttons and keys as this frame finds them.
MouseHeld mouse_held();
bool mouse_pressed(); ///< a button has gone down in this frame
/// What the wheel makes of the size of things in this frame.
double wheel_factor(MouseStyle style);

/// Gives a view a camera, and with it all cameras that turn together with this one.
void take_camera(ViewSettings& settings, View view, const Camera& camera);

/// What the chosen tool does with the mouse in a view.
/// @param from  upper left corner of the view in the window, pixels
void use_tool(Frame& frame, View view, const Mouse& mouse, ImVec2 from, ImDrawList* draw);

/// Whether a click is all that a tool needs.
bool tool_clicks(Tool tool);
/// What a click with such a tool does at a pixel of a view.
void click_with_tool(Frame& frame, View view, glm::dvec2 pixel, glm::dvec2 size);

/// What the places cover that were clicked for a measurement to be, pixels of the view.
std::vector<PixelBox> measuring_dots(Frame& frame, View view, glm::dvec2 size);

/// Where the view cube of a view of this size lies, pixels of the view; nothing where there is no
/// room for it, and in a flat view.
std::optional<PixelBox> cube_place(const Frame& frame, View view, glm::dvec2 size);
/// Draws the cube and follows the mouse on it. @returns whether the mouse is busy with it
bool view_cube(Frame& frame, View view, const PixelBox& place, const Mouse& mouse, ImVec2 from, ImDrawList* draw);
/// The axes of space, lower left, beside the legend. @returns what of the view it covers, pixels;
/// nothing if there is no room
std::optional<PixelBox> axis_triad(const Frame& frame, View view, const std::optional<PixelBox>& legend,
                                   glm::dvec2 size, ImVec2 from, ImDrawList* draw);

/// Small buttons at the right end of a view's title; a narrow view keeps those that matter most.
void view_buttons(Frame& frame, View view);

} // namespace spia::viewer
