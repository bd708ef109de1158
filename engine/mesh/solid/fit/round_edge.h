#pragma once
#include <Eigen/Core>
#include <optional>

namespace spia {

/// A circle in space, as the edge of a hole in plane sheet is one.
struct RoundEdge {
    Eigen::Vector3d centre, axis; ///< mm; unit length
    double radius = 0;            ///< mm

    /// From the axis to a place.
    Eigen::Vector3d off_axis(const Eigen::Vector3d& p) const { return p - centre - height(p) * axis; }
    double height(const Eigen::Vector3d& p) const { return (p - centre).dot(axis); }
    /// Whether places lie around it as the corners of its chords do, which are of 30 degrees at
    /// most: with no gap of more than 35.
    bool surrounded(const Eigen::Matrix3Xd& places) const;
};

/// The circle across an axis that fits places best in the sense of least squares. They have to
/// surround it, eight or more.
/// @param within  mm, how far each may be off
/// @returns nothing where they are not on one
std::optional<RoundEdge> round_edge(const Eigen::Matrix3Xd& places, const Eigen::Vector3d& axis, double within);

} // namespace spia
