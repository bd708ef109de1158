#pragma once
#include <functional>
#include <map>
#include <vector>

#include "engine/mesh/solid/marks/sheet_marks.h"
#include "engine/mesh/solid/skin.h"
#include "engine/mesh/solid/thin_solid.h"

namespace spia {

/// Where a mark begins on its skin: a row of points, closed if it ends where it begins; else it
/// ends at the rim of the sheet.
struct MarkOutline {
    SheetSide skin = SheetSide::outer;
    Eigen::Matrix3Xd point;   ///< 3 by #points, mm
    Eigen::Matrix3Xd inwards; ///< 3 by #points, unit length: into the sheet
};

/// The edges between marks and their skins, those around islands at the level of the skin as well,
/// in rows.
/// @param plain  the same solid without its marks
std::vector<MarkOutline> mark_outlines(const TriMesh& solid, const ThinSolid& sheet, const PlainSolid& plain);

/// Rows along edges of a skin. @param next from vertex to vertex of the solid, with what is
/// outlined to the right
/// @param on_skin  triangles that say which way is into the sheet; @param normal per triangle its
/// area vector, outwards
std::vector<MarkOutline> outlines_along(std::multimap<int, int> next, SheetSide skin, const TriMesh& solid,
                                        const Eigen::Matrix3Xd& normal, const std::function<bool(int)>& on_skin);

/// Its points on a surface of the sheet, about: moved straight through it.
Eigen::Matrix3Xd on_surface(const MarkOutline& outline, Skin surface, double thickness);

} // namespace spia
