#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/core/length_unit.h"
#include "engine/exchange/lines/read_dxf.h"
#include "engine/unfold/sheet_lines.h"

namespace spia {

/// Reads lines by the ending of the file: DXF (read_dxf()) or JSON (the form is documented in
/// engine/pipeline/README.md).
/// @param otherwise the unit of a file that names none
/// @throws InputError naming file, place and fault; also if the file has no line
DxfLines read_line_file(const std::filesystem::path& file, LengthUnit otherwise = LengthUnit::mm);

/// Lines as such a JSON file, mm.
std::string lines_json(std::span<const SheetLine> lines);

/// Writes lines as FOLDER/NAME.dxf, .iges, .step and .json.
/// @param formats some of these endings
/// @returns the files
std::vector<std::filesystem::path> write_line_files(const std::filesystem::path& folder, const std::string& name,
                                                    std::span<const SheetLine> lines,
                                                    const std::vector<std::string>& formats);

} // namespace spia
