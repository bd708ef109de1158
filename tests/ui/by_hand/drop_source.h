#pragma once
#include <filesystem>
#include <vector>

namespace spia::viewer {

/// Lets files fall on a window, as a file manager does: the source's side of the XDND protocol,
/// version 5 [freedesktop.org].
/// @param window  of X
/// @param x, y    pixels of the screen
/// @throws Error if the window does not take them within 10 s
void drop_files(unsigned long window, const std::vector<std::filesystem::path>& files, int x, int y);

} // namespace spia::viewer
