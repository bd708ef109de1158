#pragma once
#include <Eigen/Core>
#include <glm/gtc/quaternion.hpp>

#include "engine/mesh/tri_mesh.h"

namespace spia::viewer {

/// A turn of the camera in which nothing of the mesh stands before a place on it and the sheet
/// there is not seen on edge: the one given if that is so already, otherwise the nearest of 26; the
/// one given if all are hidden.
/// @param place  mm; on the mesh, or beside it
glm::dquat clear_sight(const TriMesh& mesh, const Eigen::Vector3d& place, const glm::dquat& turn);

} // namespace spia::viewer
