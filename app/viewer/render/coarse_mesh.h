#pragma once
#include <cstdint>
#include <vector>

#include "app/viewer/model/document/scene.h"

namespace spia::viewer {

/// Fewer triangles between some of the vertices of a mesh: its picture while a view moves.
struct CoarseMesh {
    Eigen::Matrix<uint32_t, 3, Eigen::Dynamic> triangle; ///< vertices of the fine mesh
    std::vector<uint32_t> face;                          ///< of the fine mesh, whose value and mark
                                                         ///< a triangle shows
};

/// The vertices in each cube of a lattice become one of them, the triangles between three cubes
/// stay [Rossignac and Borrel, Multi-resolution 3D approximations for rendering complex scenes,
/// 1993]. Linear in the number of triangles; the shape moves by at most the diagonal of a cube.
/// @param about  so many triangles are aimed at; on smooth sheets the outcome is within a factor of
/// two
CoarseMesh coarse_mesh(const SceneMesh& mesh, int about);

} // namespace spia::viewer
