#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/tri_mesh.h"
#include "tests/support/profile.h"

/// Sheets with both their skins and the faces across the thickness, as CAD systems give them.
namespace spia::shapes {

/// A surface with the normals of the smooth surface that its vertices lie on.
struct BentSheet {
    TriMesh mesh;
    Eigen::Matrix3Xd normal; ///< 3 by #V, unit length, outwards
    std::vector<int> piece;  ///< per triangle: of the profile, from 0
};

/// A profile in the xz plane, extruded along y; the outer side is to the left of the profile.
/// @param edge mm, about
BentSheet bent_sheet(const Profile& profile, double length, double edge);

/// Without the cells (pairs of triangles) in whose middle a condition holds: holes.
template <class Cut> BentSheet without(BentSheet sheet, const Cut& cut)
{
    std::vector<int> kept, piece;
    const auto middle = [&](int f) {
        return Eigen::Vector3d(sheet.mesh.position(Eigen::all, sheet.mesh.triangle.col(f)).rowwise().mean());
    };
    for (int f = 0; f < sheet.mesh.triangles(); ++f)
        if (!cut(Eigen::Vector3d((middle(f) + middle(f ^ 1)) / 2))) {
            kept.push_back(f);
            piece.push_back(sheet.piece[size_t(f)]);
        }
    sheet.mesh.triangle = Eigen::Matrix3Xi(sheet.mesh.triangle(Eigen::all, kept));
    sheet.piece = piece;
    return sheet;
}

/// A closed mesh: the outer skin as it is, then the inner one (vertex v is #V + v, triangle f is #F
/// + f), then two triangles at each edge of the boundary. @param inwards 3 by #V, mm: from an outer
/// to its inner vertex
TriMesh thickened(const TriMesh& outer, const Eigen::Matrix3Xd& inwards);

/// A step in a skin: some of its triangles are moved, with walls between them and the others. Where
/// they reach the rim its faces follow. @param solid of thickened(), perhaps with steps already:
/// new triangles come last
/// @param skin_faces  of each skin; @param chosen of the first of them: of one skin; of the inner
/// one away from the rim
/// @param way  3 by #V, mm, of chosen triangles
TriMesh stepped(const TriMesh& solid, int skin_faces, const std::vector<char>& chosen, const Eigen::Matrix3Xd& way);

/// CAD faces of the above: pieces of the outer skin, of the inner one, and one for each edge loop
/// in each direction.
std::vector<int> cad_faces(const BentSheet& sheet, const TriMesh& solid);

} // namespace spia::shapes
