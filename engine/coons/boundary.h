#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/coons/quad_grid.h"
#include "engine/forming/blank.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Four vertices of the outline of the blank, counter-clockwise, that make good corners of a quad
/// grid: the outline turns sharply to the left there (measured over a few percent of its length, so
/// that a jagged edge does not count), and opposite sides are about equally long. On a smooth
/// outline the lengths decide: a circle gives four quarters. Deterministic. The first corner is the
/// one that lies lowest to the left (least x + y).
/// @throws InputError if the outline has no extent
std::array<int, 4> propose_corners(const Blank& blank, const TriMesh& part);

/// Cuts the outer boundary of the blank at four vertices. The first corner becomes (u, v) = (0, 0),
/// the next one counter-clockwise (1, 0). Corners given clockwise are taken the other way round,
/// from the same first one; in a crossed order they are an error, since two of them were then
/// probably mixed up.
/// @throws InputError if a corner is not on the outer boundary, appears twice or out of order, or a
/// side has no length
/// @param file_number per vertex its number in messages; empty: as in the mesh
BlankBoundary split_boundary(const Blank& blank, const TriMesh& part, const std::array<int, 4>& corners,
                             const std::vector<int>& file_number = {});

/// A place on one side of the blank: between the vertices a and b, which are neighbours on it.
struct SidePoint {
    int a = -1, b = -1;
    double weight = 0; ///< of b; 0 and 1 are the vertices themselves
};

/// Length from the start of a side to each of its vertices, over the whole length: 0 to 1 without
/// decrease.
Eigen::VectorXd chord_parameters(const std::vector<int>& side, const Eigen::Matrix2Xd& plane);

/// The place with chord-length parameter t, 0 <= t <= 1.
SidePoint point_on_side(const std::vector<int>& side, const Eigen::VectorXd& chord, double t);

} // namespace spia
