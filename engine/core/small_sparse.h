#pragma once
#include <Eigen/SparseCore>
#include <memory>

// Eigen's factors of sparse matrices, instantiated here, once: see small_dense.h. Those of the
// forming solver, which factors one pattern many times, are in engine/sparse.
namespace spia {

/// L D L^T of a symmetric matrix.
class SparseLdlt {
public:
    /// @param symmetric  its lower triangle is read
    explicit SparseLdlt(const Eigen::SparseMatrix<double>& symmetric);
    ~SparseLdlt();

    /// False if a pivot was 0: there is no factor then.
    bool ok() const;
    /// @param right  of each solution a column
    Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

private:
    struct Factor;
    std::unique_ptr<const Factor> factor_;
};

/// L U with pivots.
class SparseLu {
public:
    explicit SparseLu(const Eigen::SparseMatrix<double>& matrix);
    ~SparseLu();

    /// False if the matrix is singular: there is no factor then.
    bool ok() const;
    /// @param right  of each solution a column
    Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

private:
    struct Factor;
    std::unique_ptr<const Factor> factor_;
};

} // namespace spia
