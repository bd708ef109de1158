#pragma once
#include <Eigen/Core>
#include <optional>

#include "engine/forming/material/hardening.h"
#include "engine/forming/material/material.h"

namespace spia {

/// Principal stresses and everything Newton needs of the membrane law at given principal
/// logarithmic strains.
struct PlaneStress {
    double equivalent_strain;
    double equivalent_stress; ///< MPa
    Eigen::Vector2d stress;   ///< MPa, principal, Cauchy
    Eigen::Matrix2d tangent;  ///< MPa, d stress_k / d eps_l, symmetric
    double work;              ///< MPa, integral of sigma_eq d eps_eq
};

/// Stress in the principal axes of the strain, where a sheet that is not isotropic in its plane has
/// shear stress too. Components 11, 22, 12; strains with the engineering shear 2 eps_12.
struct AxisStress {
    double equivalent_strain;
    double equivalent_stress; ///< MPa
    Eigen::Vector3d stress;   ///< MPa, Cauchy
    Eigen::Matrix3d tangent;  ///< MPa, d stress / d strain, symmetric
    Eigen::Matrix3d metric;   ///< eps_eq^2 = eps^T metric eps
    double secant;            ///< MPa, sigma_eq / eps_eq
    double slope;             ///< MPa, d sigma_eq / d eps_eq
    double work;              ///< MPa, integral of sigma_eq d eps_eq
};

/// Hill 1948, plane stress, incompressible, total (Hencky) theory. In the sheet's material axes (1
/// rolling, 2 across),
///   sigma_eq^2 = (G+H) sigma_11^2 - 2 H sigma_11 sigma_22 + (F+H) sigma_22^2 + 2 N sigma_12^2,
///   G = 1/(1+r0),  H = r0/(1+r0),  F = r0/(r90 (1+r0)),  N = (r0+r90)(1+2 r45) / (2 r90 (1+r0))
///   [Hill 1948]
/// and the strains follow the normal to it, eps = eps_eq/sigma_eq M sigma with M the matrix of that
/// form, so that
///   eps_eq^2 = eps^T M^-1 eps,  sigma = sigma_eq/eps_eq M^-1 eps = dW/deps,
///   W(eps) = integral of sigma_eq d eps_eq.
/// The hardening curve is the one along the rolling direction. Without one the sheet is isotropic
/// in its plane: r0 = r45 = r90 = the mean normal anisotropy, whence
///   eps_eq  = (1+r)/sqrt(1+2r) sqrt(eps_1^2 + eps_2^2 + 2r/(1+r) eps_1 eps_2)
///   sigma_k = (sigma_eq/eps_eq) (1+r)^2/(1+2r) (eps_k + r/(1+r) eps_l)
class MembraneLaw {
public:
    /// @param rolling radians from the blank's x axis to the rolling direction; not given: normal
    /// anisotropy
    MembraneLaw(const Material& material, const StressCurve::Options& options = {}, std::optional<double> rolling = {});

    /// The law with normal anisotropy, whatever the rolling direction.
    PlaneStress operator()(const Eigen::Vector2d& strain) const;

    /// The law as it is.
    /// @param axes   principal axes of the strain in the blank, a rotation
    /// @param strain principal logarithmic strains along them
    AxisStress operator()(const Eigen::Matrix2d& axes, const Eigen::Vector2d& strain) const;

    /// With normal anisotropy, whatever the rolling direction; the axes do not matter then.
    AxisStress normal(const Eigen::Vector2d& strain) const { return at(normal_metric(), strain); }

    const StressCurve& curve() const { return curve_; }
    double young() const { return young_; }

private:
    struct Flow {
        double stress, secant, slope, work; ///< MPa
        bool elastic;
    };
    Flow flow(double equivalent_strain) const;
    Eigen::Matrix3d normal_metric() const;
    AxisStress at(const Eigen::Matrix3d& metric, const Eigen::Vector2d& strain) const;

    StressCurve curve_;
    double young_;
    Eigen::Matrix2d metric_;                ///< eps_eq^2 = eps^T metric eps, for normal anisotropy
    std::optional<Eigen::Matrix3d> planar_; ///< M^-1 in the axes of the blank
};

} // namespace spia
