#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/fill_holes.h"
#include "engine/mesh/locate.h"

namespace spia {

/// A field of the part at places on it, such as the nodes of a lifted grid: linear over each face.
/// Over filled holes it goes on as the mean of its neighbours at each vertex of the fill, so
/// between the values at the edge of the hole.
/// @param at_vertices  one value per vertex of the part
/// @param place  on filled.mesh
/// @throws InputError if there is not one finite value per vertex of the part, or a place is none
Eigen::VectorXd carry_field(const FilledMesh& filled, const Eigen::VectorXd& at_vertices,
                            const std::vector<MeshPoint>& place);

} // namespace spia
