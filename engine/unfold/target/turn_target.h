#pragma once
#include <array>
#include <optional>
#include <vector>

#include "engine/unfold/target/target_surface.h"

namespace spia {

/// The face with its inner side outside.
TargetSurface turned_over(const TargetSurface& face);

/// The same face with its development cut where it is farthest from some points and the edges
/// between them; a plane or a smooth face as it is.
/// @param edges pairs of columns of `point`, each less than half a turn long
/// @returns none if the edges run all the way around the axis
std::optional<TargetSurface> turned_towards(const TargetSurface& face, const Eigen::Matrix3Xd& point,
                                            const std::vector<std::array<int, 2>>& edges);

/// The middle of what some angles and the edges between them cover of the circle: opposite to the
/// widest gap.
/// @param angle radians @param edges pairs of angles, each less than half a turn apart
/// @returns radians, of many turns any; none: no angle, or all around is covered
std::optional<double> middle_around(const Eigen::VectorXd& angle, const std::vector<std::array<int, 2>>& edges);

/// The development of sheet that lies on a face and may wind around it more than once, from edge to
/// edge on from point 0.
/// @param edges as above; they join all points
/// @returns 2 by #points, mm; none if a way along the edges ends elsewhere than another: a tube
std::optional<Eigen::Matrix2Xd> unwound(const TargetSurface& face, const Eigen::Matrix3Xd& point,
                                        const std::vector<std::array<int, 2>>& edges);

} // namespace spia
