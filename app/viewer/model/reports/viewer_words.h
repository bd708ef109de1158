#pragma once
#include <string>

#include "app/viewer/model/document/document.h"

namespace spia::viewer {

/// What the engine advises, with the viewer's buttons in place of the flags of the command line.
std::string in_viewer_words(std::string text);

/// What the panel of steps calls a stage.
const char* heading(Stage stage);

/// With a capital letter at its beginning, unless that is a name: of a file or a folder, or what stands before a colon.
std::string as_sentence(std::string text);
/// The same with a full stop at its end.
std::string sentence(std::string text);

/// What a region's tool or sheet is, with units: "120 kN, friction 0.12 on both sides"; empty: nothing.
/// @param lengths  in which its thickness is told
std::string load_words(const FaceRegion& region, LengthUnit lengths = LengthUnit::mm);

} // namespace spia::viewer
