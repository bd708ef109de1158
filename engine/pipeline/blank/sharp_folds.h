#pragma once
#include "engine/forming/blank.h"
#include "engine/part/part_file.h"
#include "engine/unfold/plan/bend_table.h"

namespace spia {

/// Which fibre of the sheet was laid flat, in thicknesses from the hollow side of a bend: 0.5 of a
/// middle surface and of a part that is no solid of sheet, else as its skin lies. @param bulges the
/// bend does, on the outer side of the part's faces
double laid_fibre(const PartFile& part, bool bulges);

/// Adds the folds without a radius to a table of the bends on a blank: straight lines between two
/// regions of the part, from edge to edge of the sheet (FreeEnds). What the blank has there is
/// exact: the legs of the surface that was laid flat, to the line where they meet.
void add_sharp_folds(const PartFile& part, const Blank& blank, BendTable& table);

} // namespace spia
