#pragma once
#include <vector>

#include "engine/mesh/solid/border/beside_solid.h"
#include "engine/mesh/solid/border/slab_projection.h"
#include "engine/mesh/solid/skin.h"

namespace spia {

/// Moves border vertices of a middle surface's bends, where they are beside the solid, along their
/// rulings to where it ends, if a wall square to the sheet is there and the border crosses them.
/// @param loops  how far it is beside the solid
/// @param under  per triangle that the surface's are called by, what it lies on
/// @returns the surface moved; triangles that would turn over stay
TriMesh along_rulings(const SkinMesh& middle, const std::vector<BesideLoop>& loops,
                      const std::vector<StatedSurface>& under, const GivenSolid& solid, double tolerance);

} // namespace spia
