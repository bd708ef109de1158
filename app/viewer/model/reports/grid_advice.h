#pragma once
#include <string>
#include <string_view>

#include "engine/pipeline/session.h"

namespace spia::viewer {

/// Inner angle of the outline of the blank at one of its vertices, degrees (0 to 360): between the
/// places that are a share of its length away to both sides, so that a jagged edge does not count.
/// @param loop  vertices of the outline in their order, either way around
/// @param at    place in `loop`
double outline_angle_deg(const Eigen::Matrix2Xd& plane, const std::vector<int>& loop, size_t at, double share = 0.02);

/// What to do next about a grid that could not be made, in a sentence or two: which corner to move
/// and where to, or which method to choose.
/// @param session  with a blank, and the options of the grid
/// @param message  that comes before it: where that names the corner, what is wrong with it is not
/// said again
std::string grid_advice(const Session& session, std::string_view message = {});

} // namespace spia::viewer
