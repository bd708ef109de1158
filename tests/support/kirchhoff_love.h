#pragma once
#include <functional>
#include <vector>

#include "engine/nurbs/multi_patch.h"

/// A linear isogeometric Kirchhoff-Love shell [Kiendl, Bletzinger, Linhard & Wuechner 2009]:
/// displacements of the control points only, whose second derivatives are the bending. It is here
/// to show that an analysis stands on the surfaces that the program writes.
namespace spia::analysis {

struct Shell {
    MultiPatch patches;
    double thickness = 1, young = 1, poisson = 0;
    Eigen::Vector3d load = Eigen::Vector3d::Zero(); ///< per area of the middle surface
    /// Which of the displacements x, y, z of a control point are held; by its number of
    /// shared_controls() and its place.
    std::function<std::array<bool, 3>(int number, const Eigen::Vector3d& place)> held;
    /// Patches are joined by their shared control points alone, which leaves a hinge; the change of
    /// the angle between them is held by so many times the bending stiffness over the length of a
    /// span. 0: hinges.
    double hinge_stiffness = 1e3;
};

struct Solution {
    SharedControls shared;
    Eigen::Matrix3Xd displacement; ///< of each shared control point
    double energy = 0;             ///< half the work of the load
};

/// @throws std::runtime_error if the shell is held too little
Solution solve(const Shell& shell);

Eigen::Vector3d displacement_at(const Shell& shell, const Solution& solution, int patch, double u, double v);

/// The energy of given displacements of the shared control points: 0 for a motion as a rigid body.
double energy(const Shell& shell, const Eigen::Matrix3Xd& displacement);

/// The same surfaces with every span halved, so many times: knot insertion [NURBS Book, A5.4 one
/// knot at a time].
MultiPatch refined(const MultiPatch& patches, int times);

} // namespace spia::analysis
