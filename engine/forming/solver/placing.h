#pragma once
#include "engine/forming/process/process.h"
#include "engine/forming/solver/membrane.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// Axes of the blank in space: x as near to the part's own x axis as the plane allows.
Eigen::Matrix<double, 3, 2> blank_plane(const Eigen::Vector3d& direction);

/// Turns and moves the blank so that it lies, area by area, as near as it can under the part seen
/// along the stamping direction. [Kabsch 1976 in the plane]
void place_under_part(const TriMesh& part, const std::vector<Element>& element,
                      const Eigen::Matrix<double, 3, 2>& plane, Eigen::Matrix2Xd& X);

/// Turns and moves the blank so that held vertices lie as near as they can to their places; one
/// alone moves it without turning.
/// @returns the root of their mean squared distance after it, over that of the places from their
/// mean (of one: not a number) [Kabsch 1976 in the plane]
double place_on(const std::vector<HeldVertex>& held, Eigen::Matrix2Xd& X);

} // namespace spia
