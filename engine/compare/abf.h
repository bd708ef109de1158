#pragma once
#include "engine/compare/flat_map.h"
#include "engine/core/progress.h"

namespace spia {

struct AbfOptions {
    int most_steps = 100;
    double tolerance = 1e-10; ///< radians, on constraint_error and gradient_error of the result
};

/// The flat angles nearest to the part's that fit together, and what proves it.
struct AbfAngles {
    Eigen::Matrix3Xd angle;      ///< 3 by #F, radians, in the order of the corners
    Eigen::Matrix3Xd wanted;     ///< 3 by #F: the angle on the part, at inner vertices scaled to a
                                 ///< sum of 2 pi
    Eigen::VectorXd triangle;    ///< #F, multipliers of the triangles
    Eigen::Matrix2Xd vertex;     ///< 2 by #V, multipliers of planarity and wheel; 0 on the boundary
    double constraint_error = 0; ///< the largest error of a constraint, radians
    double gradient_error = 0;   ///< the largest |dL/da| f^2 / 2 of the Lagrangian: the shift of an
                                 ///< angle, radians
    int iterations = 0;
    bool converged = false;
};

/// Angle based flattening, ABF++ [Sheffer, Levy, Mogilnitsky, Bogomyakov 2005]: the angles a of
/// least sum (a - f)^2 / f^2 (f the wanted ones) whose sums are pi in each triangle and 2 pi around
/// each inner vertex, and with which the ring of triangles around each inner vertex closes: sum of
/// ln sin(a_next) - ln sin(a_previous) = 0, the logarithm of their product [as Zayer, Levy, Seidel
/// 2007]. With the logarithm the Hessian of the Lagrangian is diagonal and complete, so their
/// elimination of the angles and of the triangles gives Newton's method itself, with a 2 x 2 block
/// per vertex on the graph of the mesh.
/// @throws InputError as require_sheet(); @throws SolveError if the reduced system cannot be
/// factored
AbfAngles abf_angles(const TriMesh& part, const AbfOptions& options = {}, const Progress& progress = {});

/// The map with these angles, laid out by least squares (conformal_layout()) and scaled to the
/// part's area. On a disk the layout has the angles to rounding. Around a hole the method asks for
/// no closing: the angles of a part with holes may not fit together there, and the layout is the
/// nearest one; `ended` says how far it is from the angles.
FlatMap abf(const TriMesh& part, const AbfOptions& options = {}, const Progress& progress = {});

} // namespace spia
