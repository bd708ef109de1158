#pragma once
#include <string>

#include "engine/forming/flatten.h"
#include "engine/forming/membrane.h"
#include "engine/sparse/block_matrix.h"
#include "engine/sparse/cholesky.h"

namespace spia {

/// What every stage of one solution needs.
struct Job {
    const TriMesh& part;
    const std::vector<Element>& element;
    const FlattenOptions& options;
    ExternalForces& external;                 ///< what sticks to travelling tools is found on the way
    const Eigen::Matrix<double, 3, 2>& plane; ///< axes of the blank in space
    BlockMatrix& matrix;
    Cholesky& cholesky;
    bool anchored =
        false; ///< the start has the held vertices of `external` at their places: from the energy stage on they stay
};

/// The sheet of a job with another continuation of its hardening curve.
Sheet sheet_with(const Job& job, const StressCurve::Options& curve);

/// The curve continued from the uniform strain on, so that the sheet never softens: its energy is convex enough to find the
/// minimum from far away.
StressCurve::Options hardening_on(const FlattenOptions& options);

/// @param obstacle why the law as given had no solution
std::string converged_in_words(const SolveReport& report, const std::string& obstacle, double wanted_strain,
                               int vertices);

/// Whether two blanks differ by a hundredth of their size at most. The curve as given lets the sheet soften: far from the blank of
/// the continued one its equations may have another solution, in which strain gathers in a few rows of elements.
bool near_each_other(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b);

/// From a flip-free start X to the blank, with all forces of the tools at once: energy, then equilibrium; each way tried where
/// the one before did not get there.
Eigen::Matrix2Xd solve_at_once(const Job& job, Eigen::Matrix2Xd X, SolveReport& report, const Progress& progress);

} // namespace spia
