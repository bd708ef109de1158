#pragma once
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/remesh/size_field.h"

namespace spia {

/// Which vertices of a kept line a remesh keeps, and where it divides what is between two
/// neighbours.
struct LineDivision {
    std::vector<char> keep;                ///< per vertex of the line; its ends always
    std::vector<std::vector<double>> cuts; ///< per segment of the line, shares of its way,
                                           ///< increasing; some only between two kept vertices
};

/// Divides a line so that each piece is about as long as the sizes along it ask, least squares
/// of the logarithm of the ratio over the whole line. A vertex is left out only if the line stays
/// within the sagitta allowed there; all other points lie on the line.
/// @param sagitta  #V, mm
LineDivision divide_line(const TriMesh& mesh, const std::vector<int>& line, const SizeField& size,
                         const Eigen::VectorXd& sagitta, const Progress& progress = {});

} // namespace spia
