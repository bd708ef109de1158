#pragma once
#include <Eigen/Core>
#include <vector>

#include "app/viewer/model/document.h"
#include "engine/mesh/tri_mesh.h"

namespace spia::viewer {

/// A piece of a cut within one face.
struct SectionPiece {
    int face = -1;
    Eigen::Vector3d from, to;                  ///< mm, on the mesh
    double from_distance = 0, to_distance = 0; ///< mm along the drawn line, from_distance <= to_distance
    double from_value = 0, to_value = 0;       ///< linear in between
};

/// Where the plane through a drawn line cuts the faces, as far as the line goes; by rising distance along it.
/// @param mesh  the part, or its flat blank if the line was drawn there
/// @param value one per vertex
std::vector<SectionPiece> section(const TriMesh& mesh, const Eigen::VectorXd& value, const SectionLine& line);

} // namespace spia::viewer
