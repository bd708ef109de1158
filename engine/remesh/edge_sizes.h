#pragma once
#include "engine/mesh/tri_mesh.h"
#include "engine/remesh/kept_lines.h"
#include "engine/remesh/size_field.h"

namespace spia {

/// Of what lines may be off, for those of the boundary that bend within the sheet: chords there
/// take from the area of a sheet, and as much as they are off around all of it. A sheet of 1 m
/// whose outline is off by two thirds of 1 mm has an area that is 2.7e-3 too small.
constexpr double border_share = 0.05;

struct SizeLimits {
    double most;          ///< mm, edge length where nothing asks for a shorter one
    double least;         ///< mm; nothing asks for less
    double sagitta;       ///< mm, between a chord of that length and the surface or line; of the
                          ///< boundary border_share of it where that bends within the sheet
    double growth = 0.35; ///< of the length per mm of way
};

/// Per vertex, whether a line of the boundary bends there within the sheet. One that bends with the
/// sheet, as at the end of a bend, is straight once it is flat: its chords take no area.
std::vector<char> bends_within(const TriMesh& mesh, const KeptLines& lines);

/// How long the edges of a remesh should be at each vertex of the mesh and along its edges: shorter
/// where the surface or a kept line is curved, or a line is short. Curvature at a vertex is the
/// mean over a neighbourhood of the tensor of Cohen-Steiner and Morvan (2003), so that slivers do
/// not count; kept edges are not curvature.
/// @param also  what else asks for shorter edges, at vertices (none: nothing) and elsewhere
EdgeSizes edge_sizes(const TriMesh& mesh, const KeptLines& lines, const SizeLimits& limits, const EdgeSizes& also);

/// Lowers sizes so that they grow from vertex to vertex by no more than `growth` per mm.
void limit_growth(const TriMesh& mesh, double growth, Eigen::VectorXd& size);

} // namespace spia
