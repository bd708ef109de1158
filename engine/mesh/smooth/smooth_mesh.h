#pragma once
#include <vector>

#include "engine/mesh/locate.h"
#include "engine/mesh/smooth/curved_triangle.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

struct SmoothMeshOptions {
    double crease = 0.8;   ///< radians, see smooth_normals()
    double chord = 0.01;   ///< mm, by which edges of the result may miss the smooth surface
    int most_halvings = 4; ///< of an edge
    /// Where halving all edges once more could make more, it ends: a tenth of a tolerance that no
    /// file is as good as is not worth minutes.
    int most_triangles = 500'000;
};

/// The smooth surface that a mesh of elements stands for, as a finer mesh.
struct SmoothMesh {
    TriMesh mesh;                             ///< its first vertices are those of the mesh it comes from
    double chord = 0;                         ///< mm, by which the edges of that one miss the surface
    double left = 0;                          ///< mm, by which its own still do
    double asked = 0;                         ///< mm, less than that; where it is not the halvings ran out
    std::vector<int> face;                    ///< per triangle the one it comes from
    std::vector<Eigen::Matrix3d> barycentric; ///< per triangle its corners there

    std::vector<CubicTriangle> over; ///< the surface over each triangle of the one it comes from

    /// The place of the surface over one of the mesh that it comes from, mm.
    Eigen::Vector3d at(const MeshPoint& in_facets) const;
    /// A place of this mesh on the one it comes from.
    MeshPoint in_facets(const MeshPoint& place) const;
    /// Values at the vertices of the mesh it comes from, linear over its triangles, at all
    /// vertices.
    Eigen::MatrixXd at_vertices(const TriMesh& from, const Eigen::MatrixXd& value) const;
};

/// Curved triangles through the vertices, with the normals of smooth_normals() there, halved at
/// their edges until these are straight enough. A sheet of flat facets stays as it is.
/// [Vlachos et al. 2001, curved PN triangles]
SmoothMesh smooth_mesh(const TriMesh& mesh, const SmoothMeshOptions& options = {},
                       const std::vector<Eigen::Matrix3f>& given = {});

} // namespace spia
