#pragma once
#include <vector>

#include "engine/mesh/solid/sides/sheet_thickness.h"
#include "engine/mesh/solid/solid_in_pieces.h"

namespace spia {

// What has to hold of a solid of sheet. Each throws NotASheet with the face that speaks against it.
// thickness: mm, the one that most of the surface has; area: mm2, of the whole surface.

/// It is thin for its size, no block. @param thickness  of what rays found, 0: nothing
void require_thin(const SolidInPieces&, double thickness, double area);

/// Most of its surface belongs to two skins at that distance, which do not run into each other.
void require_two_sides(const SolidInPieces&, double thickness, double area);

/// Each side is in one piece, with faces across the thickness between both. Changes `sides`: specks
/// of a side become rim, slivers of triangles their skin's.
void require_connected(SolidInPieces&, double thickness, double area);

/// What is sunk into it so deep that it is no part of a skin is sunk around round holes, no pocket
/// or step.
/// @param of_hole  per piece, whether it is of a hole's wall (round_holes())
void require_no_thin_floor(const SolidInPieces&, double thickness, double area, const std::vector<char>& of_hole);

/// Of a solid with faces missing most of the outline of its skins is still where faces cross the
/// thickness.
void require_rim(const SolidInPieces&);

/// No more than a small share is coined or thickened.
/// @param marks  are passed over
void require_even(const SolidInPieces&, const std::vector<LocalThickness>&, const std::vector<SheetMark>& marks,
                  double thickness);

} // namespace spia
