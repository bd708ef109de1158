#pragma once
#include "engine/part/part_file.h"
#include "engine/unfold/plan/bend_table.h"

namespace spia {

/// Of a mesh whose digits are too few to tell its thinnest bends: a doubt of the table for sheet
/// that turns around one direction, as a bend does, and is in none of its rows over a cylinder.
void doubt_missing_bends(const PartFile& part, BendTable& table);

} // namespace spia
