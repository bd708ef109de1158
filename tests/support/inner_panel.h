#pragma once
#include "tests/support/parametric_mesh.h"

namespace spia::shapes {

/// An inner panel of 600 x 400 mm as it leaves the press, slightly crowned: a flat binder rim, a
/// draw wall all around, a large window in a sunk frame, two pockets, five beads, two embosses and
/// ten round holes. A height field over xy, so the parameters of its vertices are x and y.
struct InnerPanel {
    double depth = 47;          ///< mm, of the draw wall
    double wall_angle_deg = 78; ///< of the draw wall against the rim, at most 80
    int triangles = 20000;
};
ParametricMesh inner_panel(const InnerPanel& shape = {});

} // namespace spia::shapes
