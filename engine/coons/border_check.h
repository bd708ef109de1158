#pragma once
#include <optional>
#include <string>
#include <utility>

#include "engine/coons/grid.h"

namespace spia {

/// From direction a to direction b, counter-clockwise, in degrees, more than 0 up to 360.
double inner_angle_deg(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// The inner angle of the outline at corner k, in degrees, between the first border nodes to both
/// sides: 0 to 360.
double corner_angle_deg(const QuadGrid& grid, int k);

/// The first corner at which no grid with these border nodes can have a cell, or -1.
int impossible_corner(const QuadGrid& grid);

struct StraightCorner {
    int corner;
    double angle_deg; ///< least inner angle of the outline there
};
/// The first corner into which no cell fits wherever its border nodes slide: seen from it no place
/// of the one side is less than half a turn from any of the other, within `reach` cells.
std::optional<StraightCorner> straight_corner(const FilledMesh& filled, const BlankBoundary& boundary, int columns,
                                              int rows, double reach);

/// Whether the cells are small enough to follow the outline: their border turns around once, has
/// about the area of the blank and hardly crosses itself.
/// @param overlaps the blank lies on itself, so that its border may cross itself
bool follows_outline(const GridResult& grid, bool overlaps);

/// Whether cells with straight edges are possible between these border nodes: neither of the two
/// above is in the way.
bool border_is_possible(const GridResult& grid, bool overlaps);

/// Whether a grid is sound, and what keeps it from it, in words.
std::string soundness(const GridResult& grid, bool overlaps);

/// The vertex of the outline with the largest inner angle in the blank, and that angle in degrees.
std::pair<int, double> widest_vertex(const FilledMesh& filled);

} // namespace spia
