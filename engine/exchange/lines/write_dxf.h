#pragma once
#include <filesystem>

#include "engine/exchange/lines/blank_drawing.h"
#include "engine/exchange/lines/dxf_options.h"

namespace spia {

/// Writes a DXF file that a laser or a press brake takes. Layers:
/// - OUTLINE, HOLES: what is cut: a CIRCLE, or one closed LWPOLYLINE (R12: POLYLINE) whose arcs are
///   bulges; with splines in it LINE, ARC and SPLINE end to end
/// - BEND_UP, BEND_DOWN: dashed: the middle line of each bend, a LINE if it is straight, with a
///   TEXT of angle, inner radius and K beside it
/// - BEND_ZONE: dotted: where bends begin and end
/// - MARKS: what is scribed or sunk: polylines and circles
/// - MARKS_TEXT: of each sunk hole: what, how wide and deep, at the front (the side that is drawn,
///   the sheet's outer skin) or the back
/// Line and text of a bend have extended data of the application SPIA: texts (code 1000) `bend`,
/// its name, then a name and a number (1040) each: `angle_deg`, `inner_radius` (lengths in the unit
/// of the file), `k`, and where they are known `allowance`, `deduction` and `thickness`. Those of
/// marks have `mark`, what it is (mark, countersink, counterbore) and its side (front, back, both),
/// and where they are known `diameter`, `depth` and `hole`. Comments (999) at the beginning tell
/// which surface of the sheet the lengths are of, and its thickness. The layers but the first two
/// are there if something is on them. Numbers have 17 digits.
/// @throws InputError if there is no outline, a line is none, or splines are asked for in R12;
///         ExchangeError if the file cannot be written
void write_dxf(const std::filesystem::path& path, const BlankDrawing& drawing, const DxfOptions& options = {});

} // namespace spia
