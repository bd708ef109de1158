#pragma once
#include <filesystem>

#include "engine/exchange/blank_outline.h"
#include "engine/exchange/length_unit.h"

namespace spia {

/// Writes a DXF file (AutoCAD 2000, AC1015): each loop a closed LWPOLYLINE, the first on layer
/// OUTLINE, the others on layer HOLES. Numbers have 17 digits.
/// @param unit of the lengths in the file, which its header names
/// @throws InputError if there is no outline; ExchangeError if the file cannot be written
void write_dxf(const std::filesystem::path& path, const std::vector<OutlineLoop>& loops,
               LengthUnit unit = LengthUnit::mm);

} // namespace spia
