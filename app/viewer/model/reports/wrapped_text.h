#pragma once
#include <functional>
#include <string>
#include <string_view>

namespace spia::viewer {

/// A text with line breaks in the place of spaces, so that no line is wider than there is room; a
/// word that is wider by itself stays whole. A number keeps its unit beside it, and is never broken
/// at its point, as ImGui's own wrapping does.
/// @param width_of  a piece of text in one line
std::string broken_at_spaces(std::string_view text, float room, const std::function<float(std::string_view)>& width_of);

} // namespace spia::viewer
