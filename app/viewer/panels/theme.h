#pragma once
#include <imgui.h>
#include <string>

namespace spia::viewer {

struct Fonts {
    ImFont* text = nullptr;
    ImFont* bold = nullptr;
    ImFont* small = nullptr;
    ImFont* heading = nullptr; ///< of the manual, larger
    std::string missing;       ///< which font file was not found, if any; ImGui's own font then takes its place
};

/// Loads the interface font in the sizes for a screen scale; call before the first frame.
Fonts load_fonts(float scale);

/// Colours and spacing of all widgets.
void apply_theme(bool dark, float scale);

/// Colours with a meaning.
struct Palette {
    ImVec4 accent, good, warning, error, muted, panel, line;
};
Palette palette_of(bool dark);

} // namespace spia::viewer
