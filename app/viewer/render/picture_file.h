#pragma once
#include <filesystem>

#include "app/viewer/render/renderer.h"

namespace spia::viewer {

/// @throws ExchangeError if the picture cannot be compressed or the file cannot be written
void write_png(const std::filesystem::path& file, const Picture& picture);

/// The bytes of a PNG file, e.g. for a report that holds its pictures. @throws ExchangeError
std::string png(const Picture& picture);

} // namespace spia::viewer
