#pragma once
#include <string>

namespace spia::viewer {

/// What the engine advises, with the viewer's buttons in place of the flags of the command line.
std::string in_viewer_words(std::string text);

} // namespace spia::viewer
