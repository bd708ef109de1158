#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>
#include <set>

#include "engine/mesh/tri_mesh.h"

/// Meshes from numbered cells: plain, exact in their topology, and even.
namespace spia::shapes {

struct GridPlan {
    int columns = 10, rows = 10;
    bool around = false; ///< the last column of vertices is the first one
    bool along = false;  ///< the last row of vertices is the first one
};

/// Two triangles per cell, split along alternating diagonals. @param place u, v from 0 to 1 ->
/// point, mm; turning from u to v is counter-clockwise seen from the outer side
TriMesh grid_surface(const GridPlan& plan, const std::function<Eigen::Vector3d(double u, double v)>& place);

/// A pipe around z, open at both ends. @param top its radius at the upper end, mm: a frustum of a
/// cone where it differs
TriMesh pipe(double radius, double top, double height, int around, int rows);

using Cell = std::array<int, 3>;

/// The surface of a body of cubes, each side of a cube n x n cells of two triangles.
/// @param open  whether a side is left out: the cube, and the direction outwards; empty: none is
/// @param edge  mm, of a cube
TriMesh body_surface(const std::set<Cell>& cubes, double edge, int n,
                     const std::function<bool(const Cell& cube, const Eigen::Vector3i& outwards)>& open = {});

/// The mesh without the vertices that no face uses.
TriMesh without_strays(const TriMesh& mesh);

/// The mesh without some faces, nor the vertices that then have none.
TriMesh without_faces(const TriMesh& mesh, const std::function<bool(const Eigen::Vector3d& middle)>& left_out);

} // namespace spia::shapes
