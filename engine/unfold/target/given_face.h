#pragma once
#include "engine/mesh/tri_mesh.h"
#include "engine/unfold/target/target_surface.h"
#include "engine/unfold/target/unfold_pick.h"

namespace spia {

// Targets that are given by numbers. unfold_step() sees to it that their outer side is that of what
// they carry.

/// @param origin mm; @param normal of any length above 0
PlaneFace given_plane(const Eigen::Vector3d& origin, const Eigen::Vector3d& normal);
/// @param origin mm, on the axis; @param axis of any length above 0; @param radius mm
/// @param towards a place on the side where the face is to be: see middle_of_pick()
CylinderFace given_cylinder(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, double radius,
                            const Eigen::Vector3d& towards);
/// @param axis from the apex into the cone; @param half_angle radians
ConeFace given_cone(const Eigen::Vector3d& apex, const Eigen::Vector3d& axis, double half_angle,
                    const Eigen::Vector3d& towards);

/// Where the fixed faces of a pick are in the mean, or the freed ones where nothing is fixed. mm
Eigen::Vector3d middle_of_pick(const TriMesh& part, const UnfoldPick& pick);

} // namespace spia
