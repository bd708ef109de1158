#pragma once
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Faces of a mesh, ascending, each once.
using FaceSet = std::vector<int>;

/// @name Sets of faces of one mesh
///@{
FaceSet united(const FaceSet& a, const FaceSet& b);
FaceSet without(const FaceSet& a, const FaceSet& b);
FaceSet inverted(const FaceSet& set, int faces);         ///< all others of so many faces
FaceSet grown(const TriMesh& mesh, const FaceSet& set);  ///< with all faces that share a vertex
                                                         ///< with one of them
FaceSet shrunk(const TriMesh& mesh, const FaceSet& set); ///< without those that share a vertex with
                                                         ///< one of the others
///@}

/// What bounds a smooth region.
struct SmoothLimits {
    double sharp = 0.5;    ///< radians between neighbouring normals: a feature edge, never crossed
    double bend = 8;       ///< times 1 / diagonal of the mesh: sheet that is curved more is a bend
    double likeness = 0.6; ///< a bend ends where the curvature falls below this part of where it
                           ///< was picked, or exceeds its inverse
};

/// Finds faces that belong together; who is beside whom is worked out once. Searching from several
/// threads at a time is safe.
class RegionSearch {
public:
    /// Faces are neighbours across an edge that they alone share.
    explicit RegionSearch(const TriMesh& mesh);

    /// All faces that are reached from this one without turning by more than an angle (radians)
    /// from one face to the next.
    FaceSet flood(int face, double angle) const;

    /// The smooth piece of sheet around a face, whatever the size of the mesh's faces. On a flat or
    /// gently curved piece it ends at feature edges and where a bend begins; on a bend, such as a
    /// fillet, it is the piece with about the same curvature. Made larger or smaller, a mesh has
    /// the same regions.
    FaceSet smooth_region(int face, const SmoothLimits& limits = {}) const;

private:
    template <class May> FaceSet reached(int face, const May& may_cross) const;

    double diagonal_;                 ///< mm
    Eigen::Matrix3Xi neighbour_;      ///< across the edge from corner k to the next one; -1: none
    Eigen::Matrix3Xd angle_;          ///< between the normals, radians; across the same edges
    Eigen::Matrix3Xd edge_curvature_; ///< the same over the distance of the faces' middles, 1/mm
    Eigen::VectorXd face_curvature_;  ///< the larger principal one without its sign, 1/mm
    Eigen::VectorXd evenness_;        ///< of a face in the curvature around it, 0 to 1
};

} // namespace spia
