#pragma once
#include <vector>

#include "engine/mesh/skin.h"
#include "engine/mesh/thin_solid.h"

namespace spia {

/// Where a round hole through plane sheet is wider at a skin than inside: a counterbore, a countersink, a chamfer. One that is wider
/// at both skins is two of them.
struct SunkHole {
    SheetSide skin = SheetSide::outer;                 ///< at which it is wider
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< mm, of the circle on that skin
    Eigen::Vector3d inwards = Eigen::Vector3d::Zero(); ///< unit length, along the axis into the sheet
    double diameter = 0;                               ///< mm, of that circle
    double least = 0;            ///< mm, diameter of the hole where it is narrowest; 0: it is not round there
    double depth = 0;            ///< mm, from the skin to there
    bool counterbore = false;    ///< its wall at the skin is square to the sheet; else it is sloped
    int face = -1;               ///< of the wall, a triangle of the solid
    std::vector<int> outer = {}; ///< vertices of the solid where the hole meets the outer skin, ascending
};

/// In the order of the triangles. Those in bends, and holes whose edge is no circle, are not among them.
/// @param solid  without its marks: a shallow counterbore is one
std::vector<SunkHole> sunk_holes(const TriMesh& solid, const ThinSolid& sheet);

/// Puts the border of these holes in a middle surface straight below their edges on the outer skin. Halfway along the edges of their
/// walls it lies unevenly: those cross floors of counterbores, and end at any corner of a circle there.
void straighten_holes(SkinMesh& middle, const TriMesh& solid, const std::vector<SunkHole>& holes, double thickness);

/// Gives round holes of a middle surface their least diameter, as they are cut before they are sunk.
/// @returns how many vertices were moved
int narrow_holes(SkinMesh& middle, const std::vector<SunkHole>& holes);

/// The circle at the skin as a closed row of points on a surface of the sheet, 3 by #points, mm.
Eigen::Matrix3Xd circle_of(const SunkHole& hole, Skin surface, double thickness);

} // namespace spia
