#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "engine/forming/hardening.h"

namespace spia {

/// A sheet grade: elasticity, hardening and the r-values of Hill's 1948 yield criterion.
struct Material {
    std::string name;
    double young_MPa = 0;
    double poisson = 0;
    double density_kg_m3 = 0;
    Hardening hardening;
    double r0 = 1, r45 = 1, r90 = 1; ///< Lankford coefficients along, at 45 degrees and across the rolling direction
    std::string source;              ///< where the values come from; may be empty for a user's file

    /// Mean normal anisotropy (r0 + 2 r45 + r90) / 4, the r of the plane-stress law that the solver uses.
    double normal_anisotropy() const { return (r0 + 2 * r45 + r90) / 4; }
    friend bool operator==(const Material&, const Material&) = default;
};

/// Reads a material file (JSON, the form is documented in assets/materials/README.md).
/// @throws InputError if a value is missing or makes no sense; names the key
Material read_material(const std::filesystem::path& file);

/// Principal stresses and everything Newton needs of the membrane law at given principal logarithmic strains.
struct PlaneStress {
    double equivalent_strain;
    double equivalent_stress; ///< MPa
    Eigen::Vector2d stress;   ///< MPa, principal, Cauchy
    Eigen::Matrix2d tangent;  ///< MPa, d stress_k / d eps_l, symmetric
    Eigen::Matrix2d majorant; ///< MPa, the tangent with no less than the secant along the strain: see energy_density()
    double deviatoric;        ///< MPa, (stress_1 - stress_2) / (eps_1 - eps_2)
    double work;              ///< MPa, integral of sigma_eq d eps_eq
};

/// Hill 1948 with normal anisotropy, plane stress, incompressible, total (Hencky) theory:
///   eps_eq  = (1+r)/sqrt(1+2r) sqrt(eps_1^2 + eps_2^2 + 2r/(1+r) eps_1 eps_2)
///   sigma_k = (sigma_eq/eps_eq) (1+r)^2/(1+2r) (eps_k + r/(1+r) eps_l)
/// so that sigma = dW/deps for W(eps) = integral of sigma_eq d eps_eq.
class MembraneLaw {
public:
    MembraneLaw(const Material& material, const StressCurve::Options& options = {});

    PlaneStress operator()(const Eigen::Vector2d& strain) const;

    const StressCurve& curve() const { return curve_; }
    double young() const { return young_; }

private:
    StressCurve curve_;
    double young_;
    Eigen::Matrix2d metric_; ///< eps_eq^2 = eps^T metric eps
};

} // namespace spia
