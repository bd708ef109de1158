#pragma once
#include <array>
#include <string>

#include "engine/limits/limits.h"

/// What stands for a zone of the sheet, in the window and in print.
namespace spia {

std::string zone_words(Zone zone);                 ///< for people: "Excessive thinning"
std::array<float, 4> zone_colour(Zone zone);       ///< sRGB, opaque; told apart on light and dark
                                                   ///< ground
std::string hex(const std::array<float, 4>& srgb); ///< "#c0261c"

} // namespace spia
