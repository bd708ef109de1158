#pragma once
#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/viewer/panels/screen_text.h"
#include "app/viewer/panels/ui.h"
#include "engine/core/json_file.h"

namespace spia::viewer {

/// What the window shows, and what was done in it, for a test that has no other eyes.
struct OnScreen {
    std::vector<ScreenText> texts;               ///< of the last frame
    std::optional<std::array<ImVec2, 2>> marked; ///< by the frame around what the keyboard is at
    std::set<std::string, std::less<>> pushed;   ///< names of the actions so far
};

/// What only the window knows: its size, the texts it shows, which actions were pushed, where the
/// pictures of the views and the items of the steps lie, the mouse as the last frame saw it.
/// Pixels.
Json window_report(const Ui& ui, std::optional<View> maximised, const OnScreen& on_screen);

} // namespace spia::viewer
