#pragma once
#include <memory>

#include "engine/sparse/block_matrix.h"

namespace spia {

/// Sparse LU factor of an unsymmetric matrix (UMFPACK, symmetric strategy).
class Lu {
public:
    /// @throws SolveError if there is not enough memory
    explicit Lu(const BlockMatrix& matrix);
    ~Lu();
    /// The matrix has no inverse, up to rounding: do not solve.
    bool singular() const;
    Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace spia
