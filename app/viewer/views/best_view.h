#pragma once
#include <Eigen/Core>
#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace spia::viewer {

/// The turn of a camera from which some faces of a sheet are best seen in all of its states
/// together: of fourteen, the corners and faces of a cube, that in which most of their area is in
/// sight, by a coarse depth test. Where several are about as good it is the most usual one: a
/// corner before a face, above before below, the isometric view first.
/// @param triangle 3 by #F; @param states each 3 by #V, at least one; @param faces of the sheet
glm::dquat best_turn(const Eigen::Matrix3Xi& triangle, const std::vector<Eigen::Matrix3Xd>& states,
                     const std::vector<int>& faces);

/// How much of the faces' area is in sight from this turn, as it is seen: 1 face on, less from the
/// side and where something is before them; mean over the states.
double share_seen(const Eigen::Matrix3Xi& triangle, const std::vector<Eigen::Matrix3Xd>& states,
                  const std::vector<int>& faces, const glm::dquat& turn);

} // namespace spia::viewer
