#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/mesh/soup.h"
#include "engine/mesh/tri_mesh.h"

/// What tests do to meshes, and what they measure on them.
namespace spia::shapes {

TriMesh transformed(const TriMesh& mesh, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation);
TriMesh scaled(const TriMesh& mesh, double factor);

/// The mirror image in the plane x = 0. Triangles are turned over, so that outside stays outside.
TriMesh mirrored(const TriMesh& mesh);

struct Permuted {
    TriMesh mesh;
    std::vector<int> vertex; ///< vertex v of the given mesh is vertex[v] of the new one
    std::vector<int> face;   ///< face f of the given mesh is face[f] of the new one
};

/// The same mesh with vertices and faces in another order, and each face beginning at another of
/// its corners.
Permuted permuted(const TriMesh& mesh, std::uint64_t seed);

/// Evenly distributed over all rotations; the same for the same seed.
Eigen::Matrix3d random_rotation(std::uint64_t seed);

/// Both in one mesh, not connected; the vertices and faces of b come after those of a.
TriMesh joined(const TriMesh& a, const TriMesh& b);

PolygonSoup soup_of(const TriMesh& mesh); ///< what a file of it is read as

double mean_edge(const TriMesh& mesh);             ///< mm, every edge counted once
Eigen::VectorXd edge_lengths(const TriMesh& mesh); ///< mm, every edge once
Eigen::VectorXd least_angles(const TriMesh& mesh); ///< #F, radians
Eigen::VectorXd angle_sums(const TriMesh& mesh);   ///< #V, radians: 2 pi at an inner vertex without
                                                   ///< curvature
/// the fraction of values below the limit
double share_below(const Eigen::VectorXd& values, double limit);

/// The slope of the least-squares line through (log h, log error): 2 for a method of second order.
double convergence_order(const std::vector<double>& h, const std::vector<double>& error);

} // namespace spia::shapes
