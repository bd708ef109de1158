#pragma once
#include <Eigen/Core>

namespace spia {

/// A triangle mesh in space: the formed part. Vertex and face indices are those of every later
/// result.
struct TriMesh {
    Eigen::Matrix3Xd position; ///< 3 by #V, mm
    Eigen::Matrix3Xi triangle; ///< 3 by #F, vertex indices, counter-clockwise seen from the outer
                               ///< side

    int vertices() const { return int(position.cols()); }
    int triangles() const { return int(triangle.cols()); }
    /// Which corner of a triangle one of its vertices is.
    int corner_of(int face, int vertex) const
    {
        return triangle(0, face) == vertex ? 0 : triangle(1, face) == vertex ? 1 : 2;
    }
};

} // namespace spia
