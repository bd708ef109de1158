#include "engine/core/small_sparse.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

namespace spia {

struct SparseLdlt::Factor : Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> {
    using SimplicialLDLT::SimplicialLDLT;
};

SparseLdlt::SparseLdlt(const Eigen::SparseMatrix<double>& symmetric) : factor_(std::make_unique<Factor>(symmetric)) {}
SparseLdlt::~SparseLdlt() = default;

bool SparseLdlt::ok() const { return factor_->info() == Eigen::Success; }

Eigen::MatrixXd SparseLdlt::solve(const Eigen::MatrixXd& right) const { return factor_->solve(right); }

struct SparseLu::Factor : Eigen::SparseLU<Eigen::SparseMatrix<double>> {
    using SparseLU::SparseLU;
};

SparseLu::SparseLu(const Eigen::SparseMatrix<double>& matrix) : factor_(std::make_unique<Factor>(matrix)) {}
SparseLu::~SparseLu() = default;

bool SparseLu::ok() const { return factor_->info() == Eigen::Success; }

Eigen::MatrixXd SparseLu::solve(const Eigen::MatrixXd& right) const { return factor_->solve(right); }

} // namespace spia
