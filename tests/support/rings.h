#pragma once
#include <functional>
#include <vector>

#include "engine/mesh/tri_mesh.h"

namespace spia::shapes {

/// Triangles between closed rows of points, each row around the one before it and counter-clockwise
/// seen from the outer side. The first row may be one single point, the pole. Vertices are numbered
/// row by row.
TriMesh stitch_rings(const std::vector<Eigen::Matrix3Xd>& rings);

/// How the points of one ring are spread.
struct RingPlan {
    double s;     ///< arc length along the profile
    int points;   ///< 1: the pole
    double phase; ///< 0 or 1/2: the first point is this many steps away from the start of the ring
};

/// Rings of evenly spread points, about `edge` mm apart, every other ring turned by half a step, so
/// that triangles come near to equilateral. On walls steeper than 80 degrees rings keep count and
/// phase of the one above instead: staggered points on a vertical wall with round corners would
/// make every other facet overhang.
/// @param s              ascending arc lengths of the rings
/// @param place          arc length -> (distance outwards, z) of the ring
/// @param circumference  distance outwards -> length of the ring, mm; 0 at a pole
/// @param fold           the number of points is a multiple of this
std::vector<RingPlan> plan_rings(const std::vector<double>& s, double edge, int fold,
                                 const std::function<Eigen::Vector2d(double s)>& place,
                                 const std::function<double(double distance)>& circumference);

} // namespace spia::shapes
