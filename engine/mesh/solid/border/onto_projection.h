#pragma once
#include <vector>

#include "engine/mesh/solid/border/slab_projection.h"
#include "engine/mesh/solid/skin.h"
#include "engine/mesh/solid/stated_surface.h"

namespace spia {

/// Where the border of a middle surface is beside that of the solid (beside_loops()), it is put
/// onto the outline of the solid's projection, square to the sheet: that is where the sheet is cut,
/// whatever is sunk, chamfered or stepped at either skin. Walls that cross the whole sheet askew
/// count where they are in the middle. In bends vertices move along the rulings. A flat gets the
/// triangles of the outline then, chords of cylinders square to it of 3 degrees at most, and holes
/// that the surface did not have. What would not come nearer by that stays as it was.
/// @param middle  new vertices are called by those of the flat's border that they lie beside
/// @param under  per triangle that the surface's are called by, what it lies on; empty: not known
/// @param tolerance  mm; what is nearer to its place stays
/// @param least_edge  mm; shorter edges of flats stay
void onto_projection(SkinMesh& middle, const std::vector<StatedSurface>& under, const GivenSolid& solid,
                     double tolerance, double least_edge = 0);

} // namespace spia
