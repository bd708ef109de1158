#pragma once
#include <Eigen/Core>

namespace spia {

/// The matrix of a linear map of the plane by columns: (dx/ds, dy/ds, dx/dt, dy/dt).
using Jacobian = Eigen::Vector4d;

inline double determinant(const Jacobian& J) { return J[0] * J[3] - J[1] * J[2]; }

/// How badly a linear map distorts: mean ratio and change of area,
///     phi(J) = |J|^2 / chi(D) + area_weight (D^2 + 1) / chi(D),   D = det J,
///     chi(D) = (D + sqrt(D^2 + eps^2)) / 2.
/// With eps = 0 it is infinite for D <= 0; with eps > 0 it is finite and smooth everywhere, and
/// falls as a fold opens [Garanzha et al. 2021, Foldover-free maps in 50 lines of code].
struct ElementEnergy {
    double eps = 0;
    double area_weight = 0;

    double chi(double D) const;
    double value(const Jacobian& J) const;

    /// Gradient, and second derivative without its negative eigenvalues.
    void derivatives(const Jacobian& J, Eigen::Vector4d& gradient, Eigen::Matrix4d& hessian) const;
};

} // namespace spia
