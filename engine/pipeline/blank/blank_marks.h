#pragma once
#include "engine/exchange/lines/blank_drawing.h"
#include "engine/forming/blank.h"
#include "engine/part/part_file.h"

namespace spia {

/// Outlines of the marks that were passed over when the surface of a solid of sheet was taken, and
/// circles of its sunk holes, in the plane of its blank. Each place goes to the nearest one of the
/// part's mesh, and with its triangle into the blank; points are added where a straight piece would
/// be off by more than 1e-5 of the part, and a line that a seam cuts ends there.
std::vector<DrawnMark> marks_on_blank(const PartFile& part, const Blank& blank);

} // namespace spia
