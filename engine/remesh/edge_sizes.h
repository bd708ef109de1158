#pragma once
#include "engine/mesh/tri_mesh.h"
#include "engine/remesh/kept_lines.h"

namespace spia {

struct SizeLimits {
    double most;          ///< mm, edge length where nothing asks for a shorter one
    double least;         ///< mm; nothing asks for less
    double sagitta;       ///< mm, between a chord of that length and the surface or line
    double growth = 0.35; ///< of the length per mm of way
};

/// How long the edges of a remesh should be at each vertex of the mesh: shorter where the surface
/// or a kept line is curved, or a line is short. #V, mm. Curvature is the mean over a neighbourhood
/// of the tensor of Cohen-Steiner and Morvan (2003), so that slivers do not count; kept edges are
/// not curvature.
/// @param least_at  #V, mm: what else asks for shorter edges; empty: nothing
Eigen::VectorXd edge_sizes(const TriMesh& mesh, const KeptLines& lines, const SizeLimits& limits,
                           const Eigen::VectorXd& least_at);

/// Lowers sizes so that they grow from vertex to vertex by no more than `growth` per mm.
void limit_growth(const TriMesh& mesh, double growth, Eigen::VectorXd& size);

} // namespace spia
