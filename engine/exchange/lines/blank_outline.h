#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/forming/blank.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// A closed polygon in the plane, mm, 2 by #points; the last point is joined to the first.
using OutlineLoop = Eigen::Matrix2Xd;

/// Closed rows of boundary vertices: that around the largest area of the blank first, then the
/// holes.
/// @throws InputError if the blank is not one of this part, or the part has no boundary
std::vector<std::vector<int>> outline_vertices(const TriMesh& part, const Blank& blank);

/// Where to cut the sheet: the loop around the largest area first, then the holes.
/// @throws InputError if the blank is not one of this part, or the part has no boundary
std::vector<OutlineLoop> blank_outline(const TriMesh& part, const Blank& blank);

/// mm2, positive if the loop runs counter-clockwise
double signed_area(const OutlineLoop& loop);

/// @throws InputError unless there is a loop and each has three finite points or more
void require_outline(const std::vector<OutlineLoop>& loops);

} // namespace spia
