#pragma once
#include <optional>
#include <vector>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A plane place of a skin where a mark was, closed again.
struct RefilledMark {
    std::vector<Triangle> triangle; ///< oriented as those of the mark; no new vertices
    int beside = -1;                ///< a triangle of the skin at its edge
};

/// Closes a skin over a mark by the polygon along which the mark meets it: whatever its walls and its floor look like.
/// @param mark    per triangle, whether it is of the mark
/// @param skin    per triangle, whether it is of the skin and of no mark
/// @param around  per vertex its triangles
/// @param flat    mm, what corners may be off the plane
/// @returns nothing if the mark reaches something else than the skin, along several loops (a hole through its inside, say), or where
///          the skin is not plane
std::optional<RefilledMark> refilled_mark(const TriMesh& solid, const Eigen::Matrix3Xd& normal,
                                          const std::vector<int>& faces, const std::vector<char>& mark,
                                          const std::vector<char>& skin, const std::vector<std::vector<int>>& around,
                                          double flat);

} // namespace spia
