#pragma once
#include <memory>

#include "engine/sparse/block_matrix.h"

namespace spia {

/// Sparse LU factor of an unsymmetric matrix (UMFPACK, symmetric strategy).
class Lu {
public:
    /// @throws SolveError if the matrix is singular to rounding
    explicit Lu(const BlockMatrix& matrix);
    ~Lu();
    Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace spia
