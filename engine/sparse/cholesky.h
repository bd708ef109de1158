#pragma once
#include <memory>

#include "engine/sparse/block_matrix.h"

namespace spia {

/// Sparse Cholesky factor (CHOLMOD, supernodal, METIS order of the vertex graph). The symbolic analysis is made once
/// for a pattern and serves every later factor. One object belongs to one thread at a time.
class Cholesky {
public:
    /// Orders and analyses the pattern.
    explicit Cholesky(const BlockMatrix& pattern);
    ~Cholesky();
    Cholesky(Cholesky&&) noexcept;
    Cholesky& operator=(Cholesky&&) noexcept;

    /// Factors a symmetric matrix of the analysed pattern (its lower triangle is read).
    /// @returns false if the matrix is not positive definite to rounding; there is no factor then
    bool factor(const BlockMatrix& matrix);

    Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace spia
