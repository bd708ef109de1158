#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "engine/mesh/edge_uses.h"

namespace spia {

/// The ends of an edge, the lower number first.
using EdgeKey = std::pair<int, int>;
inline EdgeKey edge_key(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

struct PlaneTriangle {
    Triangle corner;
    int source; ///< the triangle of the solid that it is called by
};

/// Triangles of a surface that is laid in a plane, all the same way round. Vertices are called by
/// their numbers in the surface; those that are added come after its last.
struct PlaneTriangles {
    std::vector<Eigen::Vector2d> at; ///< mm, per vertex; of those without a triangle anything
    std::vector<int> source_vertex;  ///< per vertex that of the solid; of an added one that of a
                                     ///< vertex beside it
    std::vector<PlaneTriangle> triangle;
    double way_round = 1; ///< -1 if they are seen from below

    /// @param like  the vertex beside it @returns its number
    int add(const Eigen::Vector2d& place, int like);
};

/// mm2, below 0 of a triangle that is turned over.
double area(const PlaneTriangles& triangles, const Triangle& corner);

/// Height over the longest edge of a triangle, below 0 of one that is turned over; 0 if it is a
/// point.
double quality(const PlaneTriangles& triangles, const Triangle& corner);

/// The triangles when their vertices have moved, in small steps, with other diagonals where they
/// would become next to nothing.
/// @param to  mm, per vertex @returns nothing if some turn over all the same, or a place is not a
/// number
std::optional<PlaneTriangles> moved(PlaneTriangles triangles, const std::vector<Eigen::Vector2d>& to);

} // namespace spia
