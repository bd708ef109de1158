#pragma once
#include "engine/exchange/lines/blank_drawing.h"
#include "engine/part/part_file.h"

namespace spia {

/// Outline and holes of a blank with the circles, arcs and lines that the CAD file of its part has.
/// They are taken over where the blank is no more than moved against a plane CAD face: there they
/// are as the file has them, to the last digits, however coarse the triangles are. A circle's axis
/// has to be square to the face, as that of a hole in a skin or in the middle surface of a solid
/// is. Elsewhere, in bends and where the sheet is strained, the points alone are known.
/// Of a part that was remeshed these stretches have the points of its first mesh.
/// @returns loops and stated, for parts of other files none stated
BlankDrawing stated_outline(const PartFile& part, const Blank& blank);

} // namespace spia
