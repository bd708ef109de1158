#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/length_unit.h"
#include "engine/unfold/sheet_lines.h"

namespace spia {

struct DxfLines {
    std::vector<SheetLine> lines;      ///< mm, named after their layers
    std::vector<std::string> left_out; ///< kinds of entities that are no lines here, with their
                                       ///< numbers, e.g. "3 HATCH"
};

/// Reads the lines of a text DXF file of any version: LINE, LWPOLYLINE, POLYLINE (not meshes),
/// CIRCLE, ARC, ELLIPSE and SPLINE (by its poles), in model and paper space alike. Texts that
/// write_dxf() puts beside bends are passed over. Curves, also the arcs of polylines (bulges),
/// become chords (dxf_curves.h). Entities of blocks are not read.
/// @param otherwise the unit of a file whose header names none
/// @throws InputError if there is no such file, it is no text DXF, or a number is none: names the
/// line
DxfLines read_dxf(const std::filesystem::path& file, LengthUnit otherwise = LengthUnit::mm);

} // namespace spia
