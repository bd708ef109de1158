#pragma once
#include <filesystem>
#include <span>

#include "engine/exchange/blank_outline.h"
#include "engine/exchange/length_unit.h"
#include "engine/unfold/sheet_lines.h"

namespace spia {

/// Writes a DXF file (AutoCAD 2000, AC1015): each loop a closed LWPOLYLINE, the first on layer
/// OUTLINE, the others on layer HOLES; lines on layer BENDS, open or closed as they are. Numbers have 17 digits.
/// @param bends x and y in the plane of the loops, mm; empty: there is no such layer
/// @param unit of the lengths in the file, which its header names
/// @throws InputError if there is no outline, or a line is none; ExchangeError if the file cannot be written
void write_dxf(const std::filesystem::path& path, const std::vector<OutlineLoop>& loops,
               LengthUnit unit = LengthUnit::mm, std::span<const SheetLine> bends = {});

} // namespace spia
