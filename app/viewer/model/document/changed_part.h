#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "app/viewer/model/document/stored_picks.h"
#include "engine/mesh/closest_point.h"

namespace spia::viewer {

/// Corners of a triangle, mm, and the unit normal of such corners.
Eigen::Matrix3d corners_of(const TriMesh& mesh, int triangle);
Eigen::Vector3d unit_normal(const Eigen::Matrix3d& corners);

/// A part that is not the one on which something was picked (meshed anew, renumbered, a flange
/// moved), prepared for finding the old places on it.
class ChangedPart {
public:
    /// @param search  of this mesh
    ChangedPart(const TriMesh& mesh, const ClosestPointSearch& search);

    const ClosestPointSearch& search() const { return search_; }
    double reach() const
    {
        return reach_;
    } ///< mm, how far a surface may have moved and still be
      ///< the same place
    /// The place on the new part that an old one has become. Face -1 if there is none.
    ClosestPoint find(const Eigen::Vector3d& at, const Eigen::Vector3d& normal) const;
    /// The new faces of an old patch. @param lost how many of its triangles have no counterpart,
    /// and where the first was
    std::vector<int> find(const StoredPatch& patch, int& lost, Eigen::Vector3d& where) const;
    /// The vertex of the outer boundary that an old corner has become; -1 if there is none.
    int find_corner(const Eigen::Vector3d& at) const;
    /// The vertex that an old one has become; -1 if there is none.
    int find_vertex(const StoredVertex& old) const;

private:
    const std::vector<std::vector<int>>& loops() const;
    /// The vertex of a boundary that is nearest to an old one; -1 if it is too far.
    int find_on(const std::vector<int>& loop, const Eigen::Vector3d& at) const;
    /// Whether the middle of a face lies over an old patch, not beside it.
    bool lies_on(const TriMesh& old, const ClosestPointSearch& search, const Eigen::Matrix3d& corners) const;

    const TriMesh& mesh_;
    const ClosestPointSearch& search_;
    double reach_; ///< mm
    mutable std::optional<std::vector<std::vector<int>>> loops_;
};

} // namespace spia::viewer
