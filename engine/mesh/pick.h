#pragma once
#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

struct BoxTree;

/// Where a ray meets a mesh first.
struct RayHit {
    int face = -1; ///< -1: it meets none
    /// weights of the face's three vertices, sum 1
    Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
    /// along the ray, in lengths of its direction
    double distance = std::numeric_limits<double>::infinity();
};

/// Finds the faces of a mesh that rays meet; the search structure is built once. Both sides of a
/// face count. A ray through an edge or a vertex meets one of the faces there and never slips
/// through between them. Searching from several threads at a time is safe.
class RayPicker {
public:
    /// Copies what it needs of the mesh.
    /// @throws InputError if there is no face, a face names a vertex that does not exist or a
    /// coordinate of its
    ///                     vertices is not a number; names the first such face
    explicit RayPicker(const TriMesh& mesh);
    ~RayPicker();
    RayPicker(RayPicker&&) noexcept;
    RayPicker& operator=(RayPicker&&) noexcept;

    /// The first face that the ray meets from its origin on; of several at the same distance the
    /// one with the lowest index.
    /// @param direction of any length but 0
    RayHit first(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

    /// Whether a face other than `face` lies between the eye and a place on `face`. What touches
    /// the place itself, like the faces of a second layer at the same height, does not hide it.
    bool hidden(int face, const Eigen::Vector3d& place, const Eigen::Vector3d& eye) const;

    /// All faces whose boxes are not wholly outside one of some half spaces: none inside all of
    /// them is missing, some outside may be there. Neighbours stand near each other, in no other
    /// order: asking hidden() for one after the other then finds the tree in the cache, three times
    /// as fast as in the order of a shuffled mesh.
    /// @param half_spaces  4 by #n: n.x + d >= 0 inside, columns (n, d)
    std::vector<int> near(const Eigen::Matrix4Xd& half_spaces) const;

    const Eigen::AlignedBox3d& box() const; ///< around all faces, mm

private:
    std::unique_ptr<const BoxTree> tree_;
    double touching_; ///< mm, two places that are nearer to each other count as one
};

} // namespace spia
