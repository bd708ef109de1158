#include "engine/forming/material/membrane_law.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace spia {
namespace {

/// Takes strains (11, 22, 2 x 12) from axes that are turned by a rotation to the axes it is given
/// in.
Eigen::Matrix3d strain_rotation(const Eigen::Matrix2d& turn)
{
    const double c = turn(0, 0), s = turn(1, 0);
    Eigen::Matrix3d T;
    T << c * c, s * s, -c * s, s * s, c * c, c * s, 2 * c * s, -2 * c * s, c * c - s * s;
    return T;
}

/// M^-1 of Hill's form in the material axes.
Eigen::Matrix3d hill_metric(double r0, double r45, double r90)
{
    const double G = 1 / (1 + r0), H = r0 / (1 + r0), F = r0 / (r90 * (1 + r0));
    const double N = (r0 + r90) * (1 + 2 * r45) / (2 * r90 * (1 + r0));
    Eigen::Matrix3d M;
    M << G + H, -H, 0, -H, F + H, 0, 0, 0, 2 * N;
    return M.inverse();
}

} // namespace

MembraneLaw::MembraneLaw(const Material& material, const StressCurve::Options& options, std::optional<double> rolling)
    : curve_(material.hardening, material.young_MPa, options), young_(material.young_MPa)
{
    const double r = material.normal_anisotropy();
    metric_ = hill_metric(r, r, r).topLeftCorner<2, 2>();
    if (rolling) {
        const Eigen::Matrix3d T = strain_rotation(Eigen::Rotation2Dd(-*rolling).toRotationMatrix());
        planar_ = T.transpose() * hill_metric(material.r0, material.r45, material.r90) * T;
    }
}

MembraneLaw::Flow MembraneLaw::flow(double equivalent_strain) const
{
    const FlowStress at = curve_(equivalent_strain);
    // On Hooke's line the secant is Young's modulus whatever the strain; dividing zero by zero is
    // avoided there.
    const bool elastic = equivalent_strain < 0.5 * curve_.yield_strain();
    return {at.stress, elastic ? young_ : at.stress / equivalent_strain, at.slope, at.work, elastic};
}

PlaneStress MembraneLaw::operator()(const Eigen::Vector2d& strain) const
{
    PlaneStress out;
    const Eigen::Vector2d conjugate = metric_ * strain; // eps_eq * d eps_eq / d eps
    out.equivalent_strain = std::sqrt(std::max(0.0, strain.dot(conjugate)));
    const Flow f = flow(out.equivalent_strain);
    out.equivalent_stress = f.stress;
    out.work = f.work;
    out.stress = f.secant * conjugate;
    out.tangent = f.secant * metric_;
    if (!f.elastic) {
        const Eigen::Vector2d direction = conjugate / out.equivalent_strain;
        out.tangent += (f.slope - f.secant) * direction * direction.transpose();
    }
    return out;
}

AxisStress MembraneLaw::operator()(const Eigen::Matrix2d& axes, const Eigen::Vector2d& strain) const
{
    if (!planar_)
        return at(normal_metric(), strain);
    const Eigen::Matrix3d T = strain_rotation(axes);
    return at(T.transpose() * *planar_ * T, strain);
}

Eigen::Matrix3d MembraneLaw::normal_metric() const
{
    Eigen::Matrix3d metric = Eigen::Matrix3d::Zero();
    metric.topLeftCorner<2, 2>() = metric_;
    metric(2, 2) = 0.5 * (metric_(0, 0) - metric_(0, 1));
    return metric;
}

AxisStress MembraneLaw::at(const Eigen::Matrix3d& metric, const Eigen::Vector2d& strain) const
{
    const Eigen::Vector3d e(strain[0], strain[1], 0);
    const Eigen::Vector3d conjugate = metric * e;
    AxisStress out;
    out.equivalent_strain = std::sqrt(std::max(0.0, e.dot(conjugate)));
    const Flow f = flow(out.equivalent_strain);
    out.equivalent_stress = f.stress;
    out.stress = f.secant * conjugate;
    out.tangent = f.secant * metric;
    out.metric = metric;
    out.secant = f.secant;
    out.slope = f.elastic ? f.secant : f.slope;
    out.work = f.work;
    if (!f.elastic) {
        const Eigen::Vector3d direction = conjugate / out.equivalent_strain;
        out.tangent += (f.slope - f.secant) * direction * direction.transpose();
    }
    return out;
}

} // namespace spia
