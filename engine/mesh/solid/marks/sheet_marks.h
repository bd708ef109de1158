#pragma once
#include <vector>

#include "engine/mesh/solid/sides/sheet_sides.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

struct ThinSolid;

/// Marks of up to this share of the thickness are passed over. Under one the neutral fibre moves by
/// half its depth, a tenth of the thickness: less than tables of K factors differ by for the same
/// bend (0.33 to 0.5, 0.17 of the thickness).
constexpr double deepest_mark = 0.2;

/// A shallow place of one skin of a sheet, engraved, embossed or a step.
struct SheetMark {
    std::vector<int> floor = {}; ///< triangles that lie along the skin at another level, or islands
                                 ///< at its own
    std::vector<int> wall = {};  ///< triangles between the levels
    bool raised = false;
    double depth = 0;                                ///< mm, the most
    double area = 0;                                 ///< mm2, of all its triangles
    int face = -1;                                   ///< the largest triangle
    Eigen::Vector3d place = Eigen::Vector3d::Zero(); ///< its middle, mm
};

/// Looks among the pieces that do not go on from the main part of a skin (the largest that is in
/// one) for those that keep as far from the other skin as the thickness, but for deepest_mark.
/// Those that hang together are a mark if they reach the main part of the skin along a sharp edge,
/// and either have a floor or keep away from the outline of the sheet; bends and chamfers are none.
/// @param normal  per triangle its area vector, outwards; @param flipped -1 if the triangles are
/// seen from inside; @param side per piece: walls of marks become part of their skin
std::vector<SheetMark> find_marks(const TriMesh& mesh, const Eigen::Matrix3Xd& normal, double flipped,
                                  const SurfacePieces& pieces, std::vector<PieceSide>& side, double thickness);

/// How far some pieces of a skin are from its level at most, mm. @param chosen per piece; @param
/// skin theirs
double depth_of(const TriMesh& mesh, const SurfacePieces& pieces, const std::vector<PieceSide>& side,
                const std::vector<char>& chosen, PieceSide skin, double thickness);

/// A solid of sheet without its marks.
struct PlainSolid {
    TriMesh mesh;
    std::vector<int> source_vertex; ///< per vertex that of the solid, ascending
    std::vector<int> source_face;   ///< per triangle that of the solid, ascending; of what closes a
                                    ///< skin one beside it
};

/// Closes plane skins over their marks (refilled_mark()). Elsewhere the floors of marks are put
/// back to the level of their skin and joined with it where their walls were. Depths are those of
/// the walls, where a corner of the floor has a corner of the skin straight over it: so they are
/// exact over bends, too.
/// @throws NotASheet  what is left would fold over or not be closed
PlainSolid without_marks(const TriMesh& solid, const ThinSolid& sheet);

} // namespace spia
