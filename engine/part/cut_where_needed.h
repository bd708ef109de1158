#pragma once
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/soup.h"
#include "engine/part/part_file.h"

namespace spia {

/// Cuts open what is no sheet, or where it was asked for, and turns the findings that would have
/// refused it into repairs.
/// @param file  the faces as they were read; the seam names vertices of it
void cut_where_needed(PartFile& part, SeamOptions seam, const PolygonSoup& file);

/// Says where a few cuts would let the part unroll.
void note_corners(PartFile& part, const SeamOptions& seam);

} // namespace spia
