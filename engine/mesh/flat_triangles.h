#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/mesh/edge_uses.h"

namespace spia {

/// Triangles without area are lower than this part of their longest edge. Single precision moves a
/// corner by 6e-8 of its coordinate, so a lower triangle in such a file says nothing about the
/// sheet.
constexpr double flat_height = 1e-6;

/// @param height  of the longest edge
bool is_flat(const Triangle& t, const std::vector<Eigen::Vector3d>& position, double height = flat_height);

/// What became of the triangles without area.
struct FlatRepair {
    int joined = 0;            ///< needles: their two ends at one place became one vertex
    int flipped = 0;           ///< caps: their longest edge now joins the two opposite corners
    int dropped = 0;           ///< caps on the boundary: left out
    std::vector<char> removed; ///< #T, 1 for a triangle that no longer exists
    std::vector<int> left;     ///< triangles that could not be repaired, increasing
};

/// Removes triangles without area where the surface keeps its shape and stays a surface (no edge
/// gets a third face, no vertex a second fan). Expects edges with at most two triangles,
/// consistently oriented.
FlatRepair repair_flat_triangles(std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& position);

} // namespace spia
