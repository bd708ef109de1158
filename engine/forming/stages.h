#pragma once
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
    ExternalForces& external; ///< what sticks to travelling tools is found on the way
    const Eigen::Matrix<double, 3, 2>& plane; ///< axes of the blank in space
    BlockMatrix& matrix;
    Cholesky& cholesky;
};

/// The sheet of a job with another continuation of its hardening curve.
Sheet sheet_with(const Job& job, const StressCurve::Options& curve);

/// From a flip-free start X to the blank: energy, then equilibrium; each way tried where the one before did not get there.
Eigen::Matrix2Xd solve(const Job& job, Eigen::Matrix2Xd X, SolveReport& report, const Progress& progress);

} // namespace spia
