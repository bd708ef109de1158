#pragma once
#include "engine/compare/flat_map.h"
#include "engine/compare/isometric.h"

namespace spia {

/// As rigid as possible [Liu, Zhang, Xu, Gotsman, Gortler 2008]: the least sum of A |J - R|^2 over
/// the faces, J the derivative of the map and R the rotation nearest to it, by turns: all R for the
/// map held (local), the map for all R held (global, one factor for good). No step raises the
/// energy. Nothing keeps triangles from turning over; that is counted, not mended.
/// @param start  2 by #V; empty: the flip-free conformal or harmonic start
/// @throws InputError as require_sheet(); @throws SolveError if there is no start
FlatMap arap(const TriMesh& part, const IsometricOptions& options = {}, const Progress& progress = {},
             const Eigen::Matrix2Xd& start = {});

/// |J - R|^2, for the rotation R nearest to J.
double arap_density(const Eigen::Matrix2d& J);

} // namespace spia
