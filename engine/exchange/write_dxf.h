#pragma once
#include <filesystem>

#include "engine/exchange/blank_outline.h"

namespace spia {

/// Writes a DXF file (AutoCAD 2000, AC1015, units mm): each loop a closed LWPOLYLINE, the first on layer
/// OUTLINE, the others on layer HOLES. Numbers have 17 digits.
/// @throws InputError if there is no outline; ExchangeError if the file cannot be written
void write_dxf(const std::filesystem::path& path, const std::vector<OutlineLoop>& loops);

} // namespace spia
