#include "engine/coons/element_energy.h"

#include <cmath>
#include <limits>

#include "engine/core/small_dense.h"

namespace spia {

double ElementEnergy::chi(double D) const
{
    const double root = std::hypot(D, eps);
    if (D > 0)
        return (D + root) / 2;
    return root > 0 ? eps * eps / (2 * (root - D)) : 0; // without cancellation
}

double ElementEnergy::value(const Jacobian& J) const
{
    const double D = determinant(J), X = chi(D);
    return X > 0 ? (J.squaredNorm() + area_weight * (D * D + 1)) / X : std::numeric_limits<double>::infinity();
}

void ElementEnergy::derivatives(const Jacobian& J, Eigen::Vector4d& gradient, Eigen::Matrix4d& hessian) const
{
    const double D = determinant(J), X = chi(D), root = std::hypot(D, eps);
    const double X1 = X / root;                             // chi'
    const double X2 = eps * eps / (2 * root * root * root); // chi''
    const double top = J.squaredNorm() + area_weight * (D * D + 1);
    const double phi_a = 1 / X, phi_aD = -X1 / (X * X);
    const double phi_D = 2 * area_weight * D / X - top * X1 / (X * X);
    const double phi_DD =
        2 * area_weight / X - 4 * area_weight * D * X1 / (X * X) - top * X2 / (X * X) + 2 * top * X1 * X1 / (X * X * X);
    const Eigen::Vector4d c(J[3], -J[2], -J[1], J[0]); // dD / dJ
    gradient = 2 * phi_a * J + phi_D * c;
    hessian = 2 * phi_a * Eigen::Matrix4d::Identity() + 2 * phi_aD * (J * c.transpose() + c * J.transpose()) +
              phi_DD * c * c.transpose();
    hessian(0, 3) += phi_D;
    hessian(3, 0) += phi_D;
    hessian(1, 2) -= phi_D;
    hessian(2, 1) -= phi_D;
    hessian = with_least_eigenvalue(hessian, 0);
}

} // namespace spia
