#pragma once
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Which vertices of a kept line a remesh keeps, and into how many equal pieces it divides what is
/// between two neighbours.
struct LineDivision {
    std::vector<char> keep;  ///< per vertex of the line; its ends always
    std::vector<int> pieces; ///< per segment of the line; more than 1 only between two kept
                             ///< vertices
};

/// Divides a line so that each piece is about as long as the sizes at its ends ask, least squares
/// of the logarithm of the ratio over the whole line. A vertex is left out only if the line stays
/// within the sagitta allowed there; all other points lie on the line.
/// @param size     #V, mm
/// @param sagitta  #V, mm
LineDivision divide_line(const TriMesh& mesh, const std::vector<int>& line, const Eigen::VectorXd& size,
                         const Eigen::VectorXd& sagitta, const Progress& progress = {});

} // namespace spia
