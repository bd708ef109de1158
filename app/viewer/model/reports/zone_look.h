#pragma once
#include <string>

#include "app/viewer/model/document/scene.h"
#include "engine/limits/limits.h"

/// What stands for a zone of the sheet, in the window and in print.
namespace spia::viewer {

std::string zone_words(Zone zone);     ///< for people: "Excessive thinning"
Colour zone_colour(Zone zone);         ///< sRGB, opaque; told apart on light and dark ground
std::string hex(const Colour& colour); ///< "#c0261c"

} // namespace spia::viewer
