#include "engine/forming/membrane.h"

#include <Eigen/Dense>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"

namespace spia {
namespace {

/// ln(x/y) / (x - y) for x >= y > 0, exact also where both are equal.
double log_difference_quotient(double x, double y)
{
    const double relative = (x - y) / y;
    return relative < 1e-12 ? 1 / y : std::log1p(relative) / (relative * y);
}

/// Raises the eigenvalues of a symmetric 2 x 2 matrix to at least `floor`.
Eigen::Matrix2d raised(const Eigen::Matrix2d& A, double floor)
{
    const double mean = 0.5 * (A(0, 0) + A(1, 1)), half = 0.5 * (A(0, 0) - A(1, 1));
    const double radius = std::hypot(half, A(0, 1));
    if (mean - radius >= floor)
        return A;
    if (radius == 0)
        return floor * Eigen::Matrix2d::Identity();
    const double high = std::max(mean + radius, floor);
    Eigen::Matrix2d projector = Eigen::Matrix2d::Identity() * (0.5 - 0.5 * mean / radius) + A * (0.5 / radius);
    return floor * Eigen::Matrix2d::Identity() + (high - floor) * projector;
}

using Vector4d = Eigen::Vector4d;

/// The four directions of dG in the basis of the singular vectors: (1,1), (2,2), and the mixed pair.
Eigen::Matrix4d singular_basis(const Svd2& d)
{
    Eigen::Matrix4d basis;
    const auto outer = [&](int i, int j) {
        const Eigen::Matrix2d m = d.U.col(i) * d.V.col(j).transpose();
        return Vector4d(m.reshaped());
    };
    basis << outer(0, 0), outer(1, 1), outer(0, 1), outer(1, 0);
    return basis;
}

} // namespace

std::vector<Element> elements(const TriMesh& part)
{
    std::vector<Element> result(size_t(part.triangles()));
    for (int f = 0; f < part.triangles(); ++f) {
        const Eigen::Vector3d a = part.position.col(part.triangle(0, f));
        const Eigen::Vector3d b = part.position.col(part.triangle(1, f));
        const Eigen::Vector3d c = part.position.col(part.triangle(2, f));
        const Eigen::Vector3d normal = (b - a).cross(c - a);
        const double length = (b - a).norm(), twice_area = normal.norm();
        if (!(twice_area > 0))
            throw InputError(fmt::format("face {} has no area; weld or remove it before flattening", f));
        Element& e = result[size_t(f)];
        e.area = 0.5 * twice_area;
        e.frame.col(0) = (b - a) / length;
        e.frame.col(1) = normal.cross(b - a) / (twice_area * length);
        const double x = (c - a).dot(e.frame.col(0)), y = twice_area / length;
        // Corners in the frame: (0, 0), (length, 0), (x, y).
        e.gradient.col(1) << 1 / length, -x / (length * y);
        e.gradient.col(2) << 0, 1 / y;
        e.gradient.col(0) = -e.gradient.col(1) - e.gradient.col(2);
    }
    return result;
}

Eigen::Matrix2d inverse_gradient(const Element& element, const Eigen::Matrix<double, 2, 3>& blank_corner)
{
    return blank_corner * element.gradient.transpose();
}

Eigen::Matrix<double, 4, 6> gradient_operator(const Element& e)
{
    Eigen::Matrix<double, 4, 6> B = Eigen::Matrix<double, 4, 6>::Zero();
    for (int a = 0; a < 3; ++a)
        for (int k = 0; k < 2; ++k) {
            B(k, 2 * a + k) = e.gradient(0, a);
            B(2 + k, 2 * a + k) = e.gradient(1, a);
        }
    return B;
}

Svd2 svd(const Eigen::Matrix2d& G)
{
    // G = [e+f, g-h; g+h, e-f] is a rotation part (e, h) plus a reflection part (f, g).
    const double e = 0.5 * (G(0, 0) + G(1, 1)), f = 0.5 * (G(0, 0) - G(1, 1));
    const double g = 0.5 * (G(1, 0) + G(0, 1)), h = 0.5 * (G(1, 0) - G(0, 1));
    const double sum = std::atan2(h, e), difference = std::atan2(g, f);
    const double u = 0.5 * (sum + difference), v = 0.5 * (difference - sum);
    Svd2 out;
    out.s[0] = std::hypot(e, h) + std::hypot(f, g);
    out.s[1] = out.s[0] > 0 ? G.determinant() / out.s[0] : 0; // the difference of the two would cancel
    out.U << std::cos(u), -std::sin(u), std::sin(u), std::cos(u);
    out.V << std::cos(v), -std::sin(v), std::sin(v), std::cos(v);
    return out;
}

double energy_density_value(const MembraneLaw& law, const Eigen::Matrix2d& G)
{
    // Singular values alone: no singular vectors, no trigonometry.
    const double e = G(0, 0) + G(1, 1), f = G(0, 0) - G(1, 1), g = G(1, 0) + G(0, 1), h = G(1, 0) - G(0, 1);
    const double s1 = 0.5 * (std::sqrt(e * e + h * h) + std::sqrt(f * f + g * g));
    return law({-std::log(s1), -std::log(G.determinant() / s1)}).work;
}

EnergyDensity energy_density(const MembraneLaw& law, const Eigen::Matrix2d& G)
{
    const Svd2 d = svd(G);
    const Eigen::Vector2d& s = d.s;
    const PlaneStress p = law(-s.array().log().matrix());

    // W(-ln s): first and second derivatives with respect to the singular values.
    const Eigen::Vector2d first = -p.stress.cwiseQuotient(s);
    Eigen::Matrix2d second;
    second << (p.majorant(0, 0) + p.stress[0]) / (s[0] * s[0]), p.majorant(0, 1) / (s[0] * s[1]),
        p.majorant(1, 0) / (s[0] * s[1]), (p.majorant(1, 1) + p.stress[1]) / (s[1] * s[1]);
    // Mixed directions: twist (antisymmetric in the singular basis) and flip (symmetric). [Smith et al. 2019]
    const double twist = (first[0] + first[1]) / (s[0] + s[1]);
    const double stress_per_stretch = -p.deviatoric * log_difference_quotient(s[0], s[1]);
    const double flip = (0.5 * (p.stress[0] + p.stress[1]) - stress_per_stretch * 0.5 * (s[0] + s[1])) / (s[0] * s[1]);

    const double floor = 1e-8 * p.deviatoric / (s[0] * s[0]);
    second = raised(second, floor);
    const double t = std::max(twist, floor), l = std::max(flip, floor);
    Eigen::Matrix4d H = Eigen::Matrix4d::Zero();
    H.topLeftCorner<2, 2>() = second;
    H.bottomRightCorner<2, 2>() << 0.5 * (t + l), 0.5 * (l - t), 0.5 * (l - t), 0.5 * (t + l);
    const Eigen::Matrix4d basis = singular_basis(d);

    EnergyDensity out;
    out.value = p.work;
    out.gradient = d.U * first.asDiagonal() * d.V.transpose();
    out.stiffness = basis * H * basis.transpose();
    return out;
}

MembraneForce membrane_force(const MembraneLaw& law, double h0, const Eigen::Matrix2d& G)
{
    // With M = U^T dG V and U^T dU, V^T dV the spins of the singular vectors:
    //   strain in the axes U: d eps_k = -M_kk / s_k, 2 d eps_12 = -q (s_2 M_12 + s_1 M_21), q = ln(s_1^2/s_2^2) / (s_1^2 - s_2^2),
    //   spin of V against U: (M_12 - M_21) / (s_1 + s_2),
    // both without a pole at s_1 = s_2.
    const Svd2 d = svd(G);
    const Eigen::Vector2d& s = d.s;
    const AxisStress p = law(d.U, -s.array().log().matrix());
    const double h = h0 * s[0] * s[1];
    const double q = log_difference_quotient(s[0] * s[0], s[1] * s[1]);
    Eigen::Matrix<double, 3, 4> strain; // columns: M_11, M_22, M_12, M_21
    strain << -1 / s[0], 0, 0, 0, 0, -1 / s[1], 0, 0, 0, 0, -q * s[1], -q * s[0];
    const Eigen::RowVector4d stretch(1 / s[0], 1 / s[1], 0, 0); // dh / h
    const double spin = 1 / (s[0] + s[1]);
    const Eigen::Vector3d turned(-2 * p.stress[2], 2 * p.stress[2], p.stress[0] - p.stress[1]);
    Eigen::Matrix<double, 3, 4> in_basis = h * (p.tangent * strain + p.stress * stretch);
    in_basis.col(2) += h * spin * turned;
    in_basis.col(3) -= h * spin * turned;

    const Eigen::Vector2d v1 = d.V.col(0), v2 = d.V.col(1);
    Eigen::Matrix<double, 4, 3> spread;
    spread.col(0) = (v1 * v1.transpose()).reshaped();
    spread.col(1) = (v2 * v2.transpose()).reshaped();
    spread.col(2) = (v1 * v2.transpose() + v2 * v1.transpose()).reshaped();

    MembraneForce out;
    out.force = (h * (spread * p.stress)).reshaped(2, 2);
    out.derivative = spread * in_basis * singular_basis(d).transpose();
    return out;
}

} // namespace spia
