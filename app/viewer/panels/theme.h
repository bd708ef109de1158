#pragma once
#include <imgui.h>
#include <string>

namespace spia::viewer {

struct Fonts {
    ImFont* text = nullptr;
    ImFont* bold = nullptr;
    ImFont* small = nullptr;
    ImFont* heading = nullptr; ///< of the manual, larger
    std::string missing;       ///< which font file was not found, if any; ImGui's own font then
                               ///< takes its place
};

/// Loads the interface font in the sizes for a screen scale; call before the first frame.
Fonts load_fonts(float scale);

/// Colours and spacing of all widgets.
void apply_theme(bool dark, float scale);

/// What text needs against its ground to be read [WCAG 2.1, level AA].
inline constexpr double readable = 4.5;
/// Contrast of two opaque colours, 1 to 21 [WCAG 2.1, relative luminance].
double contrast(const ImVec4& a, const ImVec4& b);
/// The colour, or as much darker that white letters on it can be read.
ImVec4 under_white(const ImVec4& colour);

/// Colours with a meaning.
struct Palette {
    ImVec4 accent, good, warning, error, muted, panel, line;
};
Palette palette_of(bool dark);

} // namespace spia::viewer
