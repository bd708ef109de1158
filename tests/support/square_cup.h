#pragma once
#include "engine/mesh/tri_mesh.h"

namespace spia::shapes {

/// A square cup, bottom up, with a flange: a smooth profile swept along rounded squares. Its bottom
/// is z = 0. Every vertex lies on the exact surface, rows of vertices along every line where a
/// radius begins or ends.
struct SquareCup {
    double punch = 70;         ///< mm, side of the square at which bottom and wall would meet
                               ///< without a radius
    double corner_radius = 10; ///< mm, of that square, seen from above
    double punch_radius = 8;   ///< mm, between bottom and wall
    double die_radius = 8;     ///< mm, between wall and flange
    double depth = 40;         ///< mm, from the flange to the bottom
    double draft_deg = 0;      ///< of the wall against the vertical; above 0 the cup is a height
                               ///< field
    double flange_width = 27;  ///< mm, flat
    int triangles = 10000;

    double area() const;
};
TriMesh square_cup(const SquareCup& shape = {});

} // namespace spia::shapes
