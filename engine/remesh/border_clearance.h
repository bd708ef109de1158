#pragma once
#include "engine/core/progress.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// How wide the gap outside the boundary is at each of its vertices (a slit, a narrow hole), mm, to
/// a factor of two; 2 `reach` where it is wider, and at inner vertices. Banks that lie on each
/// other have no gap: they count as wide.
/// @param reach  mm
Eigen::VectorXd border_clearance(const TriMesh& mesh, double reach, const Progress& progress = {});

} // namespace spia
