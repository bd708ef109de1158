#pragma once
#include <Eigen/Core>
#include <string_view>
#include <utility>
#include <vector>

/// A small font of straight strokes, so that pictures need no font file. It has the digits, a to z,
/// and of the rest what our pictures say.
namespace spia::stroke_font {

constexpr double capital_height = 6; ///< in units of the grid on which the letters are drawn

/// From the left edge of the first letter to the right edge of the last, in units.
double width(std::string_view words);

/// All strokes of a line of text: x from its left edge, y up from its base line, in units.
std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> segments(std::string_view words);

} // namespace spia::stroke_font
