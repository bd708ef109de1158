#pragma once
#include <TopoDS_Edge.hxx>
#include <span>
#include <vector>

#include "engine/core/progress.h"

namespace spia {

/// An edge that one face alone uses.
struct FreeEdge {
    TopoDS_Edge edge;
    int owner = -1; ///< the face, or the piece of sheet, that it is a border of
};

/// How far each free edge is from those of other owners, ascending, mm: the farthest of seven
/// places along it, each to the nearest edge. Edges that are farther than `most` are not in it. For
/// .cpp files of engine/exchange that hold an OcctSession.
std::vector<double> gaps_to_others(std::span<const FreeEdge> edges, double most, const Progress& progress);

/// The tolerance that closes gaps and leaves what is open: beyond it the gaps, which lie close
/// together on a scale of their logarithm, thin out. 0: there are none.
/// @param gaps  ascending
double tolerance_for(std::span<const double> gaps, double least, double most);

} // namespace spia
