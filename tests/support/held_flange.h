#pragma once
#include <Eigen/Core>
#include <functional>

#include "engine/forming/material/hardening.h"
#include "tests/support/profile.h"

namespace spia::shapes {

/// An axisymmetric flange that is held at one ring and free at its other edge.
struct HeldFlange {
    Profile meridian; ///< (r, z), mm, from the held ring to the free edge
    Swift hardening;
    double young = 206000;        ///< MPa
    double normal_anisotropy = 1; ///< r
    double thickness = 1;         ///< mm, before forming
    /// Of the surface of revolution that it is unfolded onto, dz/dR at a radius.
    std::function<double(double R)> slope = [](double) { return 0.; };
};

/// Where its rings lie when it is unfolded onto the plane of the held ring, or a surface of
/// revolution through it, inwards or outwards as the meridian begins.
struct FlangeBlank {
    Eigen::VectorXd s;         ///< mm along the meridian, from the held ring on
    Eigen::VectorXd R;         ///< mm
    Eigen::VectorXd thickness; ///< mm, of the formed flange
};

/// Solved along the meridian with nothing of the engine's solver: d(N_s r)/ds = N_theta dr/ds, N =
/// h sigma of the total Hencky theory; shooting from the free edge, where N_s = 0, with the
/// classical Runge-Kutta method. For strains up to the uniform one.
FlangeBlank held_flange_blank(const HeldFlange& flange, int steps = 400);

} // namespace spia::shapes
