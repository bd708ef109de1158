#pragma once
#include <string>

namespace spia::viewer {

/// How long a surface within a tolerance may take, in words, before it is begun.
/// @param triangles  of the part
std::string fit_cost(int triangles);

} // namespace spia::viewer
