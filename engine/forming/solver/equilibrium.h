#pragma once
#include "engine/core/attempts.h"
#include "engine/core/progress.h"
#include "engine/forming/solver/energy_stage.h"
#include "engine/forming/solver/virtual_work.h"

namespace spia {

struct EquilibriumOptions {
    int most_steps = 60;
    double tolerance = 1e-9; ///< on |R| relative to the nodal forces of a sheet at its yield stress
    StepWatch watch = {};
    int stall_steps = 10; ///< steps in which the residual has to halve
    bool allow_lu = true; ///< not: give up where a sparse LU would be needed, which costs ten steps
};

struct EquilibriumResult {
    Eigen::Matrix2Xd position;
    Ended ended = Ended::too_many_steps;
    std::vector<NewtonStep> steps;
    double residual = 0; ///< relative, at position
    Eigen::Vector3d resultant =
        /// of the forces that hold the blank: N, N, N mm about its centre
        Eigen::Vector3d::Zero();
    std::vector<AttemptReport> attempts = {}; ///< of solve_relaxed_equilibrium()
};

/// How it ended, in words.
std::string describe(const EquilibriumResult& result);

/// Solves the virtual-work equations by Newton's method with the stabilized tangent
/// (expected_stress.h) and a line search on |R| or its natural level. No step turns a triangle
/// over. The mean translation and rotation of the blank are held by three multipliers with area
/// weights instead of pinned nodes, so no node carries their resultant alone.
EquilibriumResult solve_equilibrium(const TriMesh& part, const std::vector<Element>& element, VirtualWork& work,
                                    const Eigen::Matrix2Xd& start, BlockMatrix& matrix, Cholesky& cholesky,
                                    const EquilibriumOptions& options, const Progress& progress);

/// For meshes that are too coarse or too crumpled for the equations as they are: solves them with
/// all vertices relaxed, from there without, and where that fails with ever more vertices relaxed:
/// those of the largest mismatch and those that carried the residual of the failed attempt. At the
/// end `work` holds the vertices that had to be.
EquilibriumResult solve_relaxed_equilibrium(const TriMesh& part, const std::vector<Element>& element, VirtualWork& work,
                                            const Eigen::Matrix2Xd& start, BlockMatrix& matrix, Cholesky& cholesky,
                                            const EquilibriumOptions& options, const Progress& progress);

} // namespace spia
