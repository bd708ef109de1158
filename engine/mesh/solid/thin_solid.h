#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "engine/mesh/solid/marks/sheet_marks.h"
#include "engine/mesh/solid/stated_surface.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Where a face of a solid of sheet lies. The outer skin is outside of the bends as a whole, and so
/// the larger one but for what is cut into either; of a sheet that turns as much to either side it
/// is the one with the larger area, or else that of the first face.
enum class SheetSide : char { outer, inner, rim };

struct ThinSolidOptions {
    std::vector<int> unit = {};              ///< per triangle: the CAD face it lies on, which
                                             ///< belongs to one side as a whole; empty: pieces of
                                             ///< surface are found
    std::vector<StatedSurface> surface = {}; ///< per triangle: what it is a chord of; empty: not
                                             ///< known
    /// Of a triangle, at a place of it, mm: the normal of the surface that it is a chord of,
    /// towards the triangle's own, outwards from the solid; not given: the triangle's.
    std::function<Eigen::Vector3d(int face, const Eigen::Vector3d& place, const Eigen::Vector3d& own)> normal_at = {};
    std::function<std::string(int)> face_name = {}; ///< of a triangle, for messages; not given:
                                                    ///< "face 7"
};

/// A solid of sheet taken apart: both skins, and the faces across the thickness between them.
struct ThinSolid {
    std::vector<SheetSide> side;            ///< #F
    double thickness = 0;                   ///< mm, the one that most of the sheet has
    double least = 0, most = 0;             ///< mm, what the thickness is between for 98 % of the
                                            ///< skins' area; away from its main value by chords of
                                            ///< the triangles, too
    double thin_tenth = 0, thick_tenth = 0; ///< mm: a tenth of the skins' area is thinner than the
                                            ///< first, a tenth thicker than the second
    double outer = 0, inner = 0, rim = 0;   ///< mm2
    double volume = 0;                      ///< mm3
    double flipped = 0;                     ///< -1 if the triangles are seen from inside the solid,
                                            ///< else 1
    int outlines = 0;                       ///< groups of faces across the thickness: one more than
                                            ///< there are holes
    bool bent = false;                      ///< either skin is not plane
    double rounded = 0;                     ///< share of the skins' outline where they go over into
                                            ///< the rim smoothly
    std::vector<SheetMark> marks = {};      ///< shallow places; `side` has their walls on their skin,
                                            ///< too

    double area(SheetSide of) const { return of == SheetSide::outer ? outer : of == SheetSide::inner ? inner : rim; }
};

/// Why a solid is no sheet of one thickness.
struct NotASheet : InputError {
    NotASheet(const std::string& why, int where, const Eigen::Vector3d& at, bool but_for_it = false)
        : InputError(why), face(where), place(at), sheet_but_for_it(but_for_it)
    {
    }
    int face;              ///< a triangle to look at; -1: all of it
    Eigen::Vector3d place; ///< mm
    bool sheet_but_for_it; ///< the rest is two skins at one distance, too near to each other for a
                           ///< hollow body
};

/// Finds the thickness of a solid of sheet and its sides from its surface alone. Rays go inwards
/// along the normals: where they meet a face turned against the one they come from, they give a
/// thickness, and the one that most of the area has is the sheet's. Pieces of surface (CAD faces,
/// or pieces that turn by less than 12 degrees) whose rays do so belong to a skin; those that face
/// each other belong to different skins, those beside each other without a convex edge to the same
/// one. Pieces between are settled by what lies behind them and what they touch: fillets by the
/// skin that they go on from smoothly, what touches both skins is rim. Shallow marks count to their
/// skin, see find_marks(); without_marks() takes them out.
/// @param solid  one component, manifold, seen from one side; closed, or with a face or two missing
/// @throws NotASheet the surface is not that of a sheet of one thickness: a block, a rib, a coined
/// place, sides that run into
///         each other; InputError if units do not count the triangles
ThinSolid thin_solid(const TriMesh& solid, const ThinSolidOptions& options = {}, const Progress& progress = {});

/// Whether most of a mesh lies opposite to another part of itself at a small distance, as both
/// skins of a sheet do. Looks at a few hundred faces only.
bool seems_thin_solid(const TriMesh& mesh);

} // namespace spia
