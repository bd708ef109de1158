#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "engine/core/length_unit.h"
#include "engine/unfold/sheet_lines.h"

namespace spia {

// Files of lines in space: trim lines on a binder face, bend lines, lines drawn on a part. Every
// file keeps points and order of the lines; numbers have 17 digits, and the same lines give the
// same bytes under SOURCE_DATE_EPOCH.
// @throws InputError if there is no line or one is none (two finite points or more, no two running
// ones at one place);
//         ExchangeError if the file cannot be written

/// IGES 5.3: each line one entity 126, a B-spline of degree 1 through its points by arc length,
/// with its name (406 form 15).
void write_lines_iges(const std::filesystem::path& path, std::span<const SheetLine> lines,
                      const std::string& part_name = "part", LengthUnit unit = LengthUnit::mm);

/// STEP (AP242): a geometric curve set of B-splines of degree 1, named as the lines.
void write_lines_step(const std::filesystem::path& path, std::span<const SheetLine> lines,
                      const std::string& part_name = "part", LengthUnit unit = LengthUnit::mm);

/// DXF (AutoCAD 2000): each line on the layer of its name (what a layer's name cannot hold becomes
/// an underscore), an LWPOLYLINE if all lie in the plane z = 0, else a POLYLINE in space.
void write_lines_dxf(const std::filesystem::path& path, std::span<const SheetLine> lines,
                     LengthUnit unit = LengthUnit::mm);

/// @throws InputError as above
void require_lines(std::span<const SheetLine> lines);

} // namespace spia
