#pragma once
#include <imgui.h>
#include <string>
#include <vector>

namespace spia::viewer {

/// A line of text on the screen.
struct ScreenText {
    std::string text;
    ImVec2 at, size; ///< pixels of the window
};

/// The texts that a frame shows, read off what is drawn as an eye would: letter by letter, whoever
/// has drawn them. A text that is drawn over others comes after them; letters beyond the edge of
/// their window are not there.
std::vector<ScreenText> texts_on_screen(const ImDrawData& drawn);

} // namespace spia::viewer
