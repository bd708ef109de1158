#pragma once
#include "engine/forming/material/membrane_law.h"
#include "engine/forming/solver/svd2.h"

namespace spia {

// Past yield the stress hardly depends on how large the strain is, only on its direction: the work
// is nearly a cone, and Newton's tangent, taken where a triangle is, leads far past the cone's tip
// to a stress of the opposite sign. The cure is to keep the stress as an unknown of its own: the
// linearised law, sec(eps)^-1 sigma = metric eps, gives the stress that a step expects, and the
// next tangent takes the direction of that stress in place of one of the two directions of the
// strain. At the solution both are the same, so convergence stays quadratic. [Chan, Golub and Mulet
// 1999 for total variation; Rudi, Shih and Stadler 2020 for flow with a yield stress]

/// MPa, components 11, 22, 12 in the frame of a triangle of the part.
using ElementStress = Eigen::Vector3d;

/// Tangent of the stress in the principal axes d.V with the direction of an expected stress. Its
/// eigenvalues lie between the curve's slope and its secant: with no stress expected (zero) it is
/// the secant stiffness, with the stress itself the tangent. Where the slope exceeds the secant the
/// tangent is convex and is given.
Eigen::Matrix3d stabilized_tangent(const AxisStress& p, const Svd2& d, const ElementStress& expected);

/// The stress after a change dG of the inverse deformation gradient, as the linearised law expects
/// it.
/// @param p, d     the state before
/// @param expected the stress that the step before had expected
ElementStress expected_stress(const AxisStress& p, const Svd2& d, const Eigen::Matrix2d& dG,
                              const ElementStress& expected);

} // namespace spia
