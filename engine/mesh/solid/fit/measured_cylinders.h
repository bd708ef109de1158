#pragma once
#include <vector>

#include "engine/mesh/solid/stated_surface.h"
#include "engine/mesh/solid/thin_solid.h"

namespace spia {

/// The cylinders over which the sheet of a solid is bent, measured on both its skins: a mesh does
/// not state them as a CAD file does. All vertices of a tessellated cylinder lie on it, those at
/// the rims of holes and notches as well, whatever triangles are between them. A cylinder is one of
/// the sheet where
/// - each skin has triangles with all corners on it, and a common axis and radii that differ by the
///   thickness fit the vertices of both within a thousandth of the thickness and of the smaller
///   radius. Flats around a circle are not taken for chords of it by that: folded by an angle a,
///   their corners lie t / cos(a/2) apart, more than that above 6 degrees;
/// - it ends on straight lines along its axis or at the rim, as a bend does and a cylinder in drawn
///   sheet does not;
/// - the sheet goes on tangentially from it, or it has four and more chords.
/// What was not found so is of no kind.
/// @param rounding  mm, by how much corners may lie off their places (coordinate_rounding()):
/// cylinders fit within that, too, up to a fiftieth of the thickness and a hundredth of the radius
/// @returns per triangle of the solid; `off` as measured. The same values in all triangles of one
///         cylinder on one skin.
std::vector<StatedSurface> measured_cylinders(const TriMesh& solid, const ThinSolid& sheet, double rounding = 0);

} // namespace spia
