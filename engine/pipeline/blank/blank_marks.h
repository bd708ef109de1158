#pragma once
#include "engine/forming/blank.h"
#include "engine/part/part_file.h"

namespace spia {

/// Outlines of the marks that were passed over when the surface of a solid of sheet was taken, in
/// the plane of its blank. Each place goes to the nearest one of the part's mesh, and with its
/// triangle into the blank; points are added where a straight piece would be off by more than 1e-5
/// of the part, and a line that a seam cuts ends there.
/// @returns lines of two points or more, mm; a closed one ends where it begins
std::vector<Eigen::Matrix2Xd> marks_on_blank(const PartFile& part, const Blank& blank);

} // namespace spia
