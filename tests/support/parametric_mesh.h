#pragma once
#include <Eigen/Core>
#include <functional>

#include "engine/mesh/tri_mesh.h"
#include "tests/support/region.h"

namespace spia::shapes {

struct ParametricMesh {
    TriMesh mesh;
    Eigen::Matrix2Xd parameter; ///< 2 by #V; in this plane, too, every triangle is
                                ///< counter-clockwise
};

/// Even triangles on the surface x(u, v) over a region of the (u, v) plane. Every vertex lies on
/// the surface, boundary vertices on the boundary. Edges are split, collapsed, flipped and relaxed
/// by their lengths in space, but only so that no triangle turns over in the parameter plane: over
/// a height field the mesh is one, too, and never folds. Botsch and Kobbelt 2004 (A remeshing
/// approach to multiresolution modeling), carried over to a parameter plane.
/// @param surface    (u, v) -> point, mm; u and v are about mm on the surface, except on steep
///         walls
/// @param triangles  wanted number; the actual one is within a few per cent
/// @param longest    (u, v) -> upper limit of the edge length there, mm, e.g. around small holes
ParametricMesh mesh_surface(const Region& region, const std::function<Eigen::Vector3d(const Eigen::Vector2d&)>& surface,
                            int triangles, const std::function<double(const Eigen::Vector2d&)>& longest = {});

} // namespace spia::shapes
