#pragma once
#include <string>
#include <utility>
#include <vector>

namespace spia::viewer {

/// The program first, then what draws and the libraries: name and version. Needs the context of
/// OpenGL.
std::vector<std::pair<std::string, std::string>> versions();

} // namespace spia::viewer
