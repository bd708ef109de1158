#pragma once
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "engine/unfold/plan/turns.h"

namespace spia {

/// How a face of a bend is reached from a region: the way along which the sheet turns.
struct Way {
    int region = -1;
    double length = std::numeric_limits<double>::infinity(); ///< mm
    /// the last edge of the way, towards this face
    int edge = -1;
    int before = -1; ///< the face before it
};

/// The two nearest regions of every face of a bend.
using Ways = std::vector<std::array<Way, 2>>;

/// Dijkstra from all regions at once; each face is reached by two regions at most. @param region
/// #F, -1 on bends
Ways ways_from_regions(const TriMesh& part, const SheetTurns& turns, const std::vector<int>& region);

/// Bends: connected faces of bends between the same two regions. Small ones are given to the
/// neighbour in the network.
/// @param least mm2
/// @param pairs gets the two regions of each bend, -1 for none
/// @returns per face its bend, -1 on regions
std::vector<int> split_networks(const SheetTurns& turns, const std::vector<int>& region, const Ways& ways, double least,
                                std::vector<std::pair<int, int>>& pairs);

} // namespace spia
