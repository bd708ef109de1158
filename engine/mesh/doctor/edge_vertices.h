#pragma once
#include <array>
#include <vector>

#include "engine/mesh/soup.h"

namespace spia {

/// Edges that one polygon uses alone, the lower end first, in increasing order.
/// @param same_as  per vertex the one that stands for it, as weld() gives it
std::vector<std::array<int, 2>> open_edges(const PolygonSoup& soup, const std::vector<int>& same_as);

/// A vertex of an open edge beside the inside of another open edge: a T-junction, if it belongs
/// there.
struct EdgeVertex {
    int vertex;          ///< the one that stands for its place
    int polygon, corner; ///< whose edge begins at this corner of it
    double along;        ///< of the edge, between 0 and 1
    double gap;          ///< mm
};

/// Per vertex of open edges the nearest open edge of a polygon that is not at this vertex, if it is
/// within the tolerance, and both ends of that edge are farther away; by vertices in increasing
/// order.
/// @param tolerance  mm, > 0
std::vector<EdgeVertex> edge_vertices(const PolygonSoup& soup, const std::vector<int>& same_as, double tolerance);

/// The polygons with these vertices as corners in their edges. Left out are edges none of whose
/// parts meets another open edge then, and polygons that could not be split into triangles any
/// more.
/// @param taken  set to those that became corners
PolygonSoup with_corners(const PolygonSoup& soup, const std::vector<int>& same_as,
                         const std::vector<EdgeVertex>& vertices, std::vector<EdgeVertex>& taken);

} // namespace spia
