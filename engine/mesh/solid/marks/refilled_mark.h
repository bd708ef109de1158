#pragma once
#include <optional>
#include <vector>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/solid/stated_surface.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A place of a skin where a mark was, closed again.
struct RefilledMark {
    std::vector<Triangle> triangle = {};     ///< oriented as those of the mark; vertices from #V of
                                             ///< the solid on are new ones
    std::vector<int> beside = {};            ///< per triangle one of the skin at the mark's edge,
                                             ///< on the same surface
    std::vector<Eigen::Vector3d> added = {}; ///< new vertices, on a bend: chords across it would
                                             ///< lie below it
    int vertex = -1;                         ///< one of the mark's edge, the first
};

/// A solid and one of its marks.
struct MarkedSkin {
    const TriMesh& solid;
    const Eigen::Matrix3Xd& normal;              ///< per triangle its area vector
    const std::vector<std::vector<int>>& around; ///< per vertex its triangles
    const std::vector<char>& skin;               ///< per triangle, whether it is of the skin and of
                                                 ///< no mark
    const std::vector<char>& mark;               ///< per triangle, whether it is of the mark
    const std::vector<StatedSurface>& surface;   ///< per triangle what CAD states; empty: nothing
    double flat;                                 ///< mm, what corners may be off the plane or the
                                                 ///< cylinder
};

/// Closes a skin over a mark by the polygon along which the mark meets it: whatever its walls and
/// its floor look like. Over a bend, and from there on into the flat, in the plane of the unrolled
/// skin.
/// @param faces  of the mark
/// @returns nothing if the mark reaches something else than the skin, along several loops (a hole
/// through its inside, say), or where
///          the skin is neither plane nor a cylinder, nor both, one touching the other
std::optional<RefilledMark> refilled_mark(const MarkedSkin& marked, const std::vector<int>& faces);

} // namespace spia
