#pragma once
#include "engine/part/part_file.h"

namespace spia {

/// Divides chords of the border that stand for arcs of circles about which the sheet turns, as the
/// rims of bowls, domes and cones are: the vertices that are added lie on the arc, and the area
/// that chords take is next to nothing of the sheet's (fine_turn()). Each is called by the number
/// of the vertex that it comes after. Circles of holes that cylinders cut are so already
/// (round_border()).
/// @param part  of a CAD file, with its curves and its corner_normal
void round_rims(PartFile& part);

} // namespace spia
