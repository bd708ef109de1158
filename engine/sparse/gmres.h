#pragma once
#include <Eigen/Core>
#include <functional>

namespace spia {

struct GmresResult {
    Eigen::VectorXd x;
    int iterations = 0;
    double relative_residual = 1; ///< of the preconditioned-from-the-right system, i.e. the true
                                  ///< one
};

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Solves A x = b by GMRES without restart, preconditioned from the right, starting from zero.
/// [Saad 2003, sec. 9.3]
GmresResult gmres(const LinearMap& A, const LinearMap& preconditioner, const Eigen::VectorXd& b, double tolerance,
                  int most_iterations);

} // namespace spia
