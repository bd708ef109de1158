#pragma once
#include <vector>

#include "engine/mesh/solid/thin_solid.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Which surface stands for a solid of sheet.
enum class Skin { outer, inner, middle };
const char* name(Skin skin);
Skin skin_by_name(const std::string& name); ///< @throws InputError

/// A vertex of a middle surface at a slanted edge that went straight in, for triangles not to turn
/// over.
struct StraightVertex {
    int source_vertex;                                        ///< of the solid
    Eigen::Vector3d place;                                    ///< mm, where it went
    Eigen::Vector3d wanted;                                   ///< mm, where the faces at the edge would have it
    bool certain;                                             ///< a wall crosses the middle of the sheet there
    double beside() const { return (place - wanted).norm(); } ///< mm
};

/// One surface of a solid of sheet. Its triangles are seen from the outer side of the sheet,
/// whichever it is.
struct SkinMesh {
    TriMesh mesh;
    std::vector<int> source_vertex;    ///< per vertex that of the solid, ascending; one on a
                                       ///< divided chord has that of an end
    SheetSide side = SheetSide::outer; ///< whose triangles they are: where CAD faces of them lie
    std::vector<int> source_face;      ///< per triangle that of the solid, ascending; repeats where
                                       ///< one was divided
    std::vector<StraightVertex> straightened;
    std::vector<Eigen::Vector3d> oblique; ///< mm, the middles of holes that cross the sheet askew
};

/// The middle surface is the outer skin moved inwards by half the thickness: where the inner skin
/// lies opposite at the thickness, straight towards it, else along the normal (that of the CAD
/// face, where ThinSolidOptions::normal_at knows it); at sharp edges to where the planes beside
/// them meet once they are moved; at the rim along its faces, past chamfers and roundings to the
/// wall between them. So planes, cylinders with the vertices on the surface and mitred edges are
/// exact.
/// @throws NotASheet the middle surface would fold over: a bend is too tight for the triangles of
/// the outer skin
SkinMesh skin_of(const TriMesh& solid, const ThinSolid& sheet, Skin skin, const ThinSolidOptions& options = {});

} // namespace spia
