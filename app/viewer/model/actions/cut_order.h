#pragma once
#include "engine/layout/layout.h"

namespace spia::viewer {

/// Picked vertices as a cut: in their order along the line between the two that are farthest apart
/// on the blank.
/// @param position 2 by #V, the blank, mm
/// @param vertices of the part, two or more
/// @throws InputError if there are too few, or one of the two ends is not on the border of the
/// part; names it as in the file
LayoutCut cut_through(const TriMesh& part, const Eigen::Matrix2Xd& position, const std::vector<int>& vertices,
                      const std::vector<int>& file_number);

} // namespace spia::viewer
