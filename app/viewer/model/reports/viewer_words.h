#pragma once
#include <string>

#include "app/viewer/model/document/document.h"
#include "engine/core/length_unit.h"

namespace spia::viewer {

/// What the panel of steps calls a stage.
const char* heading(Stage stage);

/// What a region's tool or sheet is, with units: "120 kN, friction 0.12 on both sides"; empty:
/// nothing.
/// @param lengths  in which its thickness is told
std::string load_words(const FaceRegion& region, LengthUnit lengths = LengthUnit::mm);

} // namespace spia::viewer
