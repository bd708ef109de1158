#pragma once
#include <vector>

#include "engine/mesh/locate.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Normals at the corners of each triangle, of the smooth surface that a mesh of elements stands
/// for. Triangles around a vertex have one normal, the mean weighted with their angles, but
/// - across an edge that turns by more than `crease`, or that turns while the sheet beside it on
///   both sides does not: that is an edge of the part;
/// - where some of the triangles are flat and others are in a bend the flat ones decide: a bend
///   begins tangentially;
/// - at the border and at edges, where triangles are on one side only, it is led on from the
///   vertices inside, as along an arc.
/// @param crease  radians
/// @param given   per triangle normals that are known, as those of CAD faces, zero where they are
///                not; empty: none
std::vector<Eigen::Matrix3d> smooth_normals(const TriMesh& mesh, double crease,
                                            const std::vector<Eigen::Matrix3f>& given = {});

struct SmoothMeshOptions {
    double crease = 0.8;   ///< radians, see smooth_normals()
    double chord = 0.01;   ///< mm, by which edges of the result may miss the smooth surface
    int most_halvings = 4; ///< of an edge
};

/// The smooth surface that a mesh of elements stands for, as a finer mesh.
struct SmoothMesh {
    TriMesh mesh;                             ///< its first vertices are those of the mesh it comes from
    double chord = 0;                         ///< mm, by which the edges of the mesh it comes from miss it
    std::vector<int> face;                    ///< per triangle the one it comes from
    std::vector<Eigen::Matrix3d> barycentric; ///< per triangle its corners there

    /// A place of this mesh on the one it comes from.
    MeshPoint in_facets(const MeshPoint& place) const;
    /// Values at the vertices of the mesh it comes from, linear over its triangles, at all vertices.
    Eigen::MatrixXd at_vertices(const TriMesh& from, const Eigen::MatrixXd& value) const;
};

/// Curved triangles through the vertices, with the normals of smooth_normals() there, halved at
/// their edges until these are straight enough. A sheet of flat facets stays as it is.
/// [Vlachos et al. 2001, curved PN triangles]
SmoothMesh smooth_mesh(const TriMesh& mesh, const SmoothMeshOptions& options = {},
                       const std::vector<Eigen::Matrix3f>& given = {});

} // namespace spia
