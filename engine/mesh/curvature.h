#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Radians per vertex: what the angles of the triangles around it lack of a full turn; 0 at the
/// border. It is zero all over a part that unrolls without strain. @param mesh manifold
Eigen::VectorXd angle_defects(const TriMesh& mesh);

/// Radians per vertex, of the triangles around it.
Eigen::VectorXd angle_sums(const TriMesh& mesh);

/// Radians per boundary loop, how it turns to the left in the surface, the sheet on the left: 2 pi
/// around a flat one, -2 pi at its holes, 0 at the ends of a tube.
std::vector<double> turnings(const TriMesh& mesh, const std::vector<std::vector<int>>& loops);

} // namespace spia
