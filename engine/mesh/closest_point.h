#pragma once
#include <limits>
#include <memory>

#include "engine/core/progress.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

struct BoxTree;

/// The place of a mesh that is nearest to a point.
struct ClosestPoint {
    int face = -1;               ///< of several equally near ones, always the same one; -1 if none
                                 ///< is within reach
    Eigen::Vector3d barycentric; ///< weights of the face's three vertices, >= 0, sum 1
    Eigen::Vector3d position;    ///< mm
    double distance = std::numeric_limits<double>::infinity(); ///< mm
};

/// Finds the nearest place of a mesh for many points; the search structure is built once. Searching
/// from several threads at a time is safe.
class ClosestPointSearch {
public:
    /// Copies what it needs of the mesh. Faces without area count as the segment or point that is
    /// left of them.
    /// @param progress  a checkpoint every few thousand faces
    /// @throws InputError if there is no face, a face names a vertex that does not exist or a
    /// coordinate of its
    ///                     vertices is not a number; names the first such face
    explicit ClosestPointSearch(const TriMesh& mesh, const Progress& progress = {});
    ~ClosestPointSearch();
    ClosestPointSearch(ClosestPointSearch&&) noexcept;
    ClosestPointSearch& operator=(ClosestPointSearch&&) noexcept;

    /// @param within  mm; nothing farther away is looked for
    ClosestPoint nearest(const Eigen::Vector3d& point, double within = std::numeric_limits<double>::infinity()) const;

private:
    std::unique_ptr<const BoxTree> tree_;
};

/// Barycentric coordinates of the place of the triangle (columns: its vertices) that is nearest to
/// the point. [Ericson, Real-Time Collision Detection, 5.1.5]
Eigen::Vector3d closest_on_triangle(const Eigen::Matrix3d& triangle, const Eigen::Vector3d& point);

} // namespace spia
