#pragma once
#include "engine/core/progress.h"
#include "engine/forming/energy_stage.h"

namespace spia {

/// A friction traction on the formed part, tangential, against the material's slip from blank to part.
struct Friction {
    Eigen::VectorXd traction;          ///< #F, MPa (N/mm2 of the part); empty where there is none
    Eigen::Matrix<double, 3, 2> plane; ///< axes of the blank in space
    Eigen::Vector3d origin;            ///< point of the blank's (0, 0) in space, up to its height
    double full_slip = 0.1;            ///< mm: below this slip the traction fades out smoothly
};

struct EquilibriumOptions {
    int most_steps = 60;
    double tolerance = 1e-9; ///< on |R| relative to the nodal forces of a sheet at its yield stress
};

struct EquilibriumResult {
    Eigen::Matrix2Xd position;
    Ended ended = Ended::too_many_steps;
    std::vector<NewtonStep> steps;
    double residual = 0;       ///< relative, at position
    Eigen::Vector3d resultant; ///< the three multipliers: N, N, N mm; what real friction would have to take
};

/// Solves the principle of virtual work on the formed part (eqs. 16-23): at each node the membrane forces h sigma of the
/// triangles around it, turned into the node's tangent plane by the smallest rotation between the two normals, are in
/// balance with friction. Newton with the exact tangent. The mean translation and rotation of the blank are held by three
/// multipliers with area weights instead of pinned nodes, so no node carries their resultant alone.
EquilibriumResult solve_equilibrium(const TriMesh& part, const std::vector<Element>& element, const MembraneLaw& law,
                                    double h0, const Friction& friction, const Eigen::Matrix2Xd& start,
                                    BlockMatrix& matrix, Cholesky& cholesky, const EquilibriumOptions& options,
                                    const Progress& progress);

/// For tests: the residual (2 by #V, unscaled, N) and its exact derivative, with the nodes' axes taken at X.
struct EquilibriumSystem {
    Eigen::VectorXd residual;
    BlockMatrix tangent;
};
EquilibriumSystem equilibrium_system(const TriMesh& part, const MembraneLaw& law, double h0, const Friction& friction,
                                     const Eigen::Matrix2Xd& axes_at, const Eigen::Matrix2Xd& X);

} // namespace spia
