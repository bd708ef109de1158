#pragma once
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/soup.h"
#include "engine/part/part_file.h"

namespace spia {

/// The part cut open where it is no sheet, or where it was asked for, with the findings that would
/// have refused it turned into repairs.
/// @param file  the faces as they were read; the seam names vertices of it
PartFile cut_where_needed(PartFile part, SeamOptions seam, const PolygonSoup& file);

/// Where a few cuts would let the part unroll; nothing if there is no such place.
std::optional<Finding> closed_corners(const PartFile& part, const SeamOptions& seam);

} // namespace spia
