#pragma once
#include "engine/exchange/lines/blank_drawing.h"
#include "engine/part/part_file.h"
#include "engine/unfold/plan/bend_table.h"
#include "engine/unfold/plan/bends.h"

namespace spia {

/// What a shop needs of a blank: outline, holes, and the bends between regions with their middle
/// lines. The inner radius is that of the surface that was laid flat, less what of the thickness
/// lies between it and the hollow side; K tells of the same: 0.5 of a middle surface and of a part
/// that is no solid of sheet, else as its skin lies.
/// @param map  of the part
/// @param face of forming the blank into the part: the thickness of the flat sheet at a bend is
/// told by it
/// @param straight_only leave out what no press brake makes: the radii of drawn parts, whose lines
/// are not straight or end in the sheet
///                      (FreeEnds); sharp folds then are those of the table, if there is one
/// @param table of the bends on this blank: what it has of a bend, radius, angle, K and lines, is
/// drawn; may be null. With straight_only
///         bends have the numbers of its rows, else those of the map
BlankDrawing drawn_blank(const PartFile& part, const BendMap& map, const Blank& blank, const SheetFields& face,
                         bool straight_only = false, const BendTable* table = nullptr);

} // namespace spia
