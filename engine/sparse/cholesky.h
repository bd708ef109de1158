#pragma once
#include <memory>

#include "engine/sparse/block_matrix.h"

namespace spia {

/// Sparse Cholesky factor (CHOLMOD, supernodal, METIS order of the vertex graph). The symbolic
/// analysis is made once for a pattern and serves every later factor. One object belongs to one
/// thread at a time.
class Cholesky {
public:
    /// Orders and analyses the pattern.
    explicit Cholesky(const BlockMatrix& pattern);
    ~Cholesky();
    Cholesky(Cholesky&&) noexcept;
    Cholesky& operator=(Cholesky&&) noexcept;

    /// Factors a symmetric matrix of the analysed pattern (its upper triangle is read).
    /// @returns false if the matrix is not positive definite to rounding; there is no factor then
    bool factor(const BlockMatrix& matrix);

    Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

    /// About the same by a factor rounded to single precision, in less than half of the time on two
    /// threads.
    Eigen::VectorXd precondition(const Eigen::VectorXd& right) const;

private:
    friend class VertexCholesky;
    struct State;
    std::unique_ptr<State> state_;
};

/// The same for a matrix with one unknown per vertex on the graph of a block matrix, in the order
/// found for that one.
class VertexCholesky {
public:
    VertexCholesky(const BlockMatrix& pattern, const Cholesky& ordered);
    ~VertexCholesky();

    /// @param value of graph_row() of the pattern; its lower triangle is read
    /// @returns as above
    bool factor(const std::vector<double>& value);

    Eigen::MatrixX2d solve(const Eigen::MatrixX2d& right) const;

private:
    std::unique_ptr<Cholesky::State> state_;
};

} // namespace spia
