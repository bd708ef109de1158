#pragma once
#include <vector>

#include "engine/coons/grid.h"

namespace spia {

/// A grid of the blank, carried onto the formed part.
struct LiftResult {
    QuadGrid lifted;              ///< node by node that of the planar grid, mm
    std::vector<MeshPoint> place; ///< per node; faces from part.triangles() on belong to filled
                                  ///< holes
    std::vector<char> on_fill;    ///< per node: 1 where it lies in a filled hole, off the part
};

/// Carries each node over with the barycentric coordinates of its blank triangle.
/// @throws InputError if a node of the grid lies outside the blank (Coons grids that were asked for
/// by name)
LiftResult lift(const GridResult& grid);

/// The same for a grid in the plane of the blank that did not come from coons_grid(): finds the
/// triangle of each node.
/// @throws InputError if a node misses the blank by more than rounding, or lies where the blank
/// overlaps itself
LiftResult lift(const QuadGrid& planar, const Blank& blank, const TriMesh& part, const Progress& progress = {});

} // namespace spia
