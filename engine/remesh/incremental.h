#pragma once
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/remesh/kept_lines.h"

namespace spia {

struct IncrementalOptions {
    double sagitta;          ///< mm, that a new edge may be off the given mesh in its middle
    double most_edges = 1e9; ///< made in all; those that went again count
    int rounds = 8;          ///< of splits, collapses, flips and smoothing; then the worst triangles are seen to
};

/// Isotropic remeshing by splits, collapses, flips and tangential smoothing, vertices projected on the given mesh. [Botsch, Kobbelt,
/// A remeshing approach to multiresolution modeling, 2004; with a size per place: Dunyach et al., Adaptive remeshing for
/// real-time mesh deformation, 2013]. Kept lines are divided once (divide_line()) and then stay.
/// @param size    of edges at each vertex, mm
/// @param search  of `mesh`
/// @throws InputError  if more edges would have to be made: names the place where the last one was
TriMesh remesh_incrementally(const TriMesh& mesh, const KeptLines& lines, const Eigen::VectorXd& size,
                             const ClosestPointSearch& search, const IncrementalOptions& options,
                             const Progress& progress = {});

} // namespace spia
