#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Normals at the corners of each triangle, of the smooth surface that a mesh of elements stands
/// for. Triangles around a vertex have one normal, the mean weighted with their angles, but
/// - across an edge that turns by more than `crease`, or that turns while the sheet beside it on
///   both sides does not: that is an edge of the part;
/// - where the sheet goes on flat behind some of the triangles and turns on behind others, the flat
///   ones decide: a bend begins tangentially;
/// - at the border and at edges, where triangles are on one side only, it is led on from the
///   vertices inside, as along an arc.
/// @param crease  radians
/// @param given   per triangle normals that are known, as those of CAD faces, zero where they are
///                not; empty: none
std::vector<Eigen::Matrix3d> smooth_normals(const TriMesh& mesh, double crease,
                                            const std::vector<Eigen::Matrix3f>& given = {});

} // namespace spia
