#pragma once
#include "app/viewer/views/scene_cache.h"
#include "engine/coons/quad_grid.h"

namespace spia::viewer {

/// The grid in the plane of the blank: folded cells in red, and with_lines all its lines.
StageShape planar_grid_shape(const QuadGrid& planar, bool with_lines);

/// The grid on the part: a layer of cells (coloured by scaled Jacobian, 0 to 1, or plain), one of
/// folded cells, all lines, the four sides in their colours.
/// @param planar the same grid in the plane, where cells fold
StageShape lifted_grid_shape(const QuadGrid& lifted, const QuadGrid& planar, bool by_quality);

/// 0 to 1 in tenths.
ColourScale quality_scale();

/// Four numbered dots. @param place 3 by 4, mm
void add_corners(Scene& scene, const Eigen::Matrix3Xd& place, bool dark);

} // namespace spia::viewer
