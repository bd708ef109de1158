#pragma once
#include <Eigen/Core>
#include <vector>

namespace spia {

/// The region that closed rows of points go around once or more, counter-clockwise ones less
/// clockwise ones, without what convex polygons cover: to 2e-9 of its size. As closed rings with
/// the region on their left, outlines counter-clockwise, holes clockwise; no corner is straight.
/// Given points are exactly where they were.
/// @param rows, without  mm, 2 by n each; what has no area covers nothing
std::vector<Eigen::Matrix2Xd> polygon_union(const std::vector<Eigen::Matrix2Xd>& rows,
                                            const std::vector<Eigen::Matrix2Xd>& without = {});

} // namespace spia
