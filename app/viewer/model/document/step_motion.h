#pragma once
#include <Eigen/Core>

namespace spia::viewer {

/// Places on the way from one state of a sheet to another. A vertex whose sheet turns goes along
/// the arc of a hinge with that angle, another one straight on.
/// @param before, after 3 by #V, mm; @param share 0 to 1
Eigen::Matrix3Xd on_the_way(const Eigen::Matrix3Xi& triangle, const Eigen::Matrix3Xd& before,
                            const Eigen::Matrix3Xd& after, double share);

} // namespace spia::viewer
