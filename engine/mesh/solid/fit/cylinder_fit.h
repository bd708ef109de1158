#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A cylinder through vertices of a mesh.
struct FittedCylinder {
    Eigen::Vector3d point; ///< mm, on the axis
    Eigen::Vector3d axis;  ///< unit
    double radius;         ///< mm
    double off;            ///< mm, of the farthest of the vertices
};

/// Unit vectors across the axis, right-handed with it.
Eigen::Matrix<double, 3, 2> across(const Eigen::Vector3d& axis);

/// The cylinder through the vertices of some faces; nothing if these do not turn.
/// @param normal  area_vectors() of the part
std::optional<FittedCylinder> cylinder_of(const TriMesh& part, const Eigen::Matrix3Xd& normal,
                                          const Eigen::Matrix3Xi& neighbour, const std::vector<int>& faces);

/// The cylinder along an axis through places, by the circle through them seen along it. [Kasa 1976]
/// Nothing if they lie on a line.
std::optional<FittedCylinder> cylinder_along(const Eigen::Vector3d& axis, const Eigen::Matrix3Xd& place);

/// Vertices of some faces, ascending.
std::vector<int> corners(const TriMesh& part, const std::vector<int>& faces);

/// The cylinder nearest to some places by least squares of the distances from it, five unknowns by
/// Gauss-Newton steps from a first one. Its axis goes through the middle of the places. Nothing if
/// that ends nowhere, or farther than the places are wide.
/// @param shift  mm, per place: how much farther from the axis than the radius it is to be, as
/// places of the other side of a sheet are
std::optional<FittedCylinder> fitted(const FittedCylinder& from, const Eigen::Matrix3Xd& place,
                                     const Eigen::VectorXd& shift);

/// mm, from the axis
double distance_from_axis(const FittedCylinder& cylinder, const Eigen::Vector3d& place);

/// @param within  mm, from the cylinder
bool lies_on(const TriMesh& part, const FittedCylinder& cylinder, int face, double within);

} // namespace spia
