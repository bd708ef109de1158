#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// The places of a mesh that are projected on a surface: all vertices first, then the midpoints of
/// the part's faces and edges. The weights integrate cubic functions exactly over each face (1/20,
/// 2/15 and 9/20 of its area).
struct MeshSamples {
    Eigen::Matrix3Xd position;  ///< mm
    std::vector<double> weight; ///< mm2, the area it stands for
    std::vector<char> counts;   ///< 0 where a hole was filled
};

/// @param part_faces  the part's faces are the mesh's first ones
MeshSamples sample_mesh(const TriMesh& mesh, int part_faces);

} // namespace spia
