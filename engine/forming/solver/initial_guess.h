#pragma once
#include <string>

#include "engine/core/progress.h"
#include "engine/forming/solver/membrane.h"
#include "engine/forming/solver/stamping_direction.h"
#include "engine/sparse/block_matrix.h"
#include "engine/sparse/cholesky.h"

namespace spia {

enum class StartMethod { projection, conformal, harmonic };

/// A flat position of every vertex without a single flipped triangle.
struct InitialGuess {
    Eigen::Matrix2Xd position; ///< mm
    StartMethod method;
};

/// Tries in turn, and takes the first without a flip:
/// - projection along the stamping direction, for height fields with no wall steeper than 65
///   degrees;
/// - the spectral conformal map [Mullen et al. 2008], which needs no projection and no pinned
///   vertices;
/// - the harmonic map onto a circle with the holes closed [Tutte 1963, Floater 1997], which cannot
///   flip.
/// @param progress one checkpoint before each of them
/// @throws SolveError if all three fail (triangles too thin for the arithmetic)
InitialGuess initial_guess(const TriMesh& part, const std::vector<Element>& element, const StampingDirection& stamping,
                           BlockMatrix& matrix, Cholesky& cholesky, const Progress& progress = {});

} // namespace spia
