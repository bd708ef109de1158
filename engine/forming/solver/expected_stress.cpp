#include "engine/forming/solver/expected_stress.h"

#include <Eigen/LU>
#include <cmath>

#include "engine/forming/solver/log_quotient.h"

namespace spia {
namespace {

/// A symmetric tensor in axes that are turned by a rotation.
ElementStress in_axes(const Eigen::Matrix2d& axes, const ElementStress& stress)
{
    const double c = axes(0, 0), s = axes(1, 0), mixed = 2 * c * s * stress[2];
    return {c * c * stress[0] + s * s * stress[1] + mixed, s * s * stress[0] + c * c * stress[1] - mixed,
            c * s * (stress[1] - stress[0]) + (c * c - s * s) * stress[2]};
}

/// The direction of the expected stress in the principal axes: at most 1 long in the norm of the
/// yield surface, and shorter where less stress is expected than the curve has.
Eigen::Vector3d direction(const AxisStress& p, const Svd2& d, const ElementStress& expected)
{
    const Eigen::Vector3d t = in_axes(d.V, expected);
    const double length = std::sqrt(std::max(0.0, t.dot(p.metric.inverse() * t)));
    return t / std::max({length, p.equivalent_stress, std::numeric_limits<double>::min()});
}

/// d eps_eq / d eps
Eigen::Vector3d along(const AxisStress& p)
{
    return p.stress / std::max(p.equivalent_stress, std::numeric_limits<double>::min());
}

} // namespace

Eigen::Matrix3d stabilized_tangent(const AxisStress& p, const Svd2& d, const ElementStress& expected)
{
    if (p.slope >= p.secant)
        return p.tangent;
    const Eigen::Vector3d c = along(p), t = direction(p, d, expected);
    return p.secant * p.metric + 0.5 * (p.slope - p.secant) * (c * t.transpose() + t * c.transpose());
}

ElementStress expected_stress(const AxisStress& p, const Svd2& d, const Eigen::Matrix2d& dG,
                              const ElementStress& expected)
{
    const Eigen::Vector2d& s = d.s;
    const Eigen::Matrix2d M = d.U.transpose() * dG * d.V;
    const double q = log_difference_quotient(s[0] * s[0], s[1] * s[1]);
    const Eigen::Vector3d strain(-M(0, 0) / s[0], -M(1, 1) / s[1], -q * (s[0] * M(0, 1) + s[1] * M(1, 0)));
    Eigen::Vector3d stress = p.stress + p.secant * (p.metric * strain);
    if (p.slope < p.secant)
        stress += (p.slope - p.secant) * along(p).dot(strain) * direction(p, d, expected);
    return in_axes(d.V.transpose(), stress);
}

} // namespace spia
