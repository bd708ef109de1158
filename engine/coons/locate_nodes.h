#pragma once
#include <array>
#include <vector>

#include "engine/coons/blank_search.h"
#include "engine/coons/grid.h"

namespace spia {

bool is_border(const QuadGrid& grid, int node);

/// The eight nodes around an inner one, counter-clockwise from the next one along u.
std::array<int, 8> ring(const QuadGrid& grid, int node);

/// Where those of them are that are on the blank.
std::vector<MeshPoint> places_around(const GridResult& grid, int node);

/// Finds the inner nodes on the blank from their positions in the plane, and judges the cells. On a
/// blank that overlaps itself it goes from the border inwards, and puts each node on the layer of
/// its neighbours.
void locate_nodes(const BlankSearch& blank, GridResult& grid);

/// No cell folds and every node is on the blank.
bool is_sound(const GridResult& grid);

} // namespace spia
