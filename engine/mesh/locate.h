#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

namespace spia {

/// A place on a triangle mesh: its coordinates are those of the face's vertices, weighted.
struct MeshPoint {
    int face = -1;                                         ///< -1: no place
    Eigen::Vector3d barycentric = Eigen::Vector3d::Zero(); ///< not negative, sum 1
    double distance = 0;                                   ///< from the point that was asked for; 0
                                                           ///< inside the face
};

/// Finds the triangle of a flat mesh in which a point lies. The triangles may be slivers, turned
/// over, or lie on top of each other. Building costs O(n log n), asking O(log n); asking from
/// several threads at once is allowed.
class PlanarLocator {
public:
    /// @param position 2 by #V; @param triangle 3 by #F. Both are copied.
    PlanarLocator(const Eigen::Matrix2Xd& position, const Eigen::Matrix3Xi& triangle);
    ~PlanarLocator();
    PlanarLocator(PlanarLocator&&) noexcept;
    PlanarLocator& operator=(PlanarLocator&&) noexcept;

    /// The nearest place of the mesh, exactly the point itself if a triangle covers it. Among
    /// equally near faces, the one in whose inside the point lies deepest, then the one with the
    /// lowest index.
    MeshPoint nearest(const Eigen::Vector2d& point) const;

    /// Every face that covers the point or misses it by no more than tolerance(), by rising index.
    std::vector<MeshPoint> covering(const Eigen::Vector2d& point) const;

    /// 1e-10 of the diagonal of the mesh: what rounding may put between a point and its face.
    double tolerance() const;

private:
    struct Tree;
    std::unique_ptr<const Tree> tree_;
};

} // namespace spia
