#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace spia {

/// Lines that divide a region from one place within.
struct Spokes {
    Eigen::Vector2d centre;
    std::vector<Eigen::Matrix2Xd> line; ///< per start: from there to the centre, both included;
                                        ///< they meet nowhere else
};

/// What radii of a disc become when a region is mapped to it: harmonically, with positive weights,
/// its border at even shares from start to start on the circle, so the map is one-to-one [Tutte
/// 1963] and the lines cross neither each other nor the border, however it is bent.
/// @param polygon  counter-clockwise, simple, 2 by #points
/// @param start    three or more indices of its points, rising
/// @returns nothing if the polygon cannot be filled, or the lines cross even where they are sampled
/// closely
std::optional<Spokes> spokes(const Eigen::Matrix2Xd& polygon, const std::vector<int>& start);

} // namespace spia
