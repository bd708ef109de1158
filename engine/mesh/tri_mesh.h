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
};

} // namespace spia
