#pragma once
#include <Eigen/Core>
#include <vector>

namespace spia {

/// Pairs of edges of closed polygons in the plane that cross or touch, neighbours on one loop apart: 0 if the sheet
/// nowhere lies on itself at its edge.
/// @param loops vertex indices; @param position 2 by #V
int crossings(const std::vector<std::vector<int>>& loops, const Eigen::Matrix2Xd& position);

/// mm, of one closed polygon
double length(const std::vector<int>& loop, const Eigen::Matrix2Xd& position);

} // namespace spia
