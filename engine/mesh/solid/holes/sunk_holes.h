#pragma once
#include <set>
#include <vector>

#include "engine/mesh/solid/marks/mark_line.h"
#include "engine/mesh/solid/marks/mark_outlines.h"
#include "engine/mesh/solid/skin.h"
#include "engine/mesh/solid/thin_solid.h"

namespace spia {

/// Where a round hole through sheet is wider at a skin than inside: a counterbore, a countersink, a
/// chamfer. One that is wider at both skins is two of them.
struct SunkHole {
    int hole = 0;                                      ///< the same of both that are of one hole,
                                                       ///< from 0
    SheetSide skin = SheetSide::outer;                 ///< at which it is wider
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< mm, of the circle on that skin
    Eigen::Vector3d inwards = Eigen::Vector3d::Zero(); ///< unit length, along the axis into the
                                                       ///< sheet
    double diameter = 0;                               ///< mm, of that circle; 0: it is on no plane
    double least = 0;                                  ///< mm, diameter of the hole where it is
                                                       ///< narrowest; 0: it is not round there
    /// mm, from the skin to there; 0: the skin is not plane; below 0: what is around the hole
    /// stands up from the skin, a nut say
    double depth = 0;
    /// its wall at the skin is square to the sheet; else it is sloped
    bool counterbore = false;
    int face = -1; ///< of the wall, a triangle of the solid
    /// vertices of the solid where the hole meets the outer skin, ascending; of cut off ones none
    std::vector<int> outer = {};
    bool cut_off = false;               ///< there is not all of the circle: a bend, a border or
                                        ///< another hole is in it
    std::vector<MarkOutline> edge = {}; ///< what there is instead of it
    /// neither one floor nor one slope leads from the circle to the hole: the depth is that of all
    /// steps
    bool stepped = false;
    /// the circle touches a border, or another hole, in a point: there is no sheet between them at
    /// that skin
    bool touching = false;
};

/// Whole ones in the order of the triangles, then those that something cuts off.
/// @param solid  without its marks
std::vector<SunkHole> sunk_holes(const TriMesh& solid, const ThinSolid& sheet);

/// How many holes on plane skin have what is sunk cut off at a skin: where a middle surface is made
/// from that one, their edges are wider than they are cut.
int cut_off_at(const std::vector<SunkHole>& holes, SheetSide skin);

/// How many holes are wider at a skin than inside.
int wider_at(const std::vector<SunkHole>& holes, SheetSide skin);

/// The numbers of the holes that are sunk into a bend, where their circle is on no plane.
std::set<int> sunk_in_bends(const std::vector<SunkHole>& holes);

/// Of those that something cuts off, the numbers of the holes that are sunk through all of the
/// sheet: no straight wall is below.
std::set<int> sunk_through(const std::vector<SunkHole>& holes, double thickness);

/// The numbers of the holes whose edge in a middle surface is not their least diameter but where
/// the wall crosses the middle of the sheet: those in bends, without a straight wall, or cut off at
/// the skin that it is made from.
std::set<int> wider_in_middle(const std::vector<SunkHole>& holes, SheetSide from, double thickness);

/// The same sheet with its outer skin called the inner one.
ThinSolid sides_exchanged(const ThinSolid& sheet);

/// Puts the border of these holes in a middle surface straight below their edges on the outer skin.
/// Halfway along the edges of their walls it lies unevenly: those cross floors of counterbores, and
/// end at any corner of a circle there.
void straighten_holes(SkinMesh& middle, const TriMesh& solid, const std::vector<SunkHole>& holes, double thickness);

/// Gives round holes of a middle surface their least diameter, as they are cut before they are
/// sunk.
/// @returns those that stay as wide as they were, for triangles not to turn over; in their order
std::vector<const SunkHole*> narrow_holes(SkinMesh& middle, const std::vector<SunkHole>& holes);

/// The circle at the skin, or what there is of it, on a surface of the sheet. The same one at both
/// skins is one line; on a skin only those at the other one are lines, for its own are its holes.
std::vector<MarkLine> lines_of(const std::vector<SunkHole>& holes, Skin surface, double thickness);

} // namespace spia
