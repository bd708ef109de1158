#pragma once
#include <Eigen/Core>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Radians per vertex: what the angles of the triangles around it lack of a full turn; 0 at the
/// border. It is zero all over a part that unrolls without strain. @param mesh manifold
Eigen::VectorXd angle_defects(const TriMesh& mesh);

} // namespace spia
