#pragma once
#include <string>

namespace spia::viewer {

/// What the engine advises, with the viewer's buttons in place of the flags of the command line.
/// With a capital letter at its beginning.
std::string as_sentence(std::string text);

std::string in_viewer_words(std::string text);

} // namespace spia::viewer
