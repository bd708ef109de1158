#pragma once
#include "tests/support/parametric_mesh.h"

namespace spia::shapes {

/// A fender-like outer panel of about 800 x 480 mm: curved both ways, a feature line along it, the
/// wheel arch cut out of its lower side, and a flange bent down along its upper side. One boundary
/// with four corners; between the lower two runs the arch, its ends rounded. The skin already
/// slopes by 19 degrees there: seen along z, flange and panel overlap when it is bent by more than
/// 71 degrees.
struct Fender {
    double flange_angle_deg = 85; ///< by which the flange is bent
    double flange_width = 18;     ///< mm, flat
    double bend_radius = 5;       ///< mm
    int triangles = 20000;
};
ParametricMesh fender(const Fender& shape = {});

} // namespace spia::shapes
