#include "engine/forming/solver/membrane.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/small_dense.h"
#include "engine/forming/solver/log_quotient.h"

namespace spia {
namespace {

using Vector4d = Eigen::Vector4d;

/// The four directions of dG in the basis of the singular vectors: (1,1), (2,2), and the mixed
/// pair.
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
    Eigen::Matrix2d G = blank_corner * element.gradient.transpose();
    if (element.metric)
        G = *element.metric * G;
    return G;
}

Eigen::Matrix<double, 4, 6> gradient_operator(const Element& e)
{
    Eigen::Matrix<double, 4, 6> B = Eigen::Matrix<double, 4, 6>::Zero();
    for (int a = 0; a < 3; ++a) {
        const Eigen::Matrix2d unit = e.metric.value_or(Eigen::Matrix2d::Identity());
        B.block<2, 2>(0, 2 * a) = e.gradient(0, a) * unit;
        B.block<2, 2>(2, 2 * a) = e.gradient(1, a) * unit;
    }
    return B;
}

Eigen::Matrix<double, 6, 6> element_stiffness(const Element& e, const Eigen::Matrix4d& H)
{
    Eigen::Matrix<double, 6, 6> K;
    for (int a = 0; a < 3; ++a) {
        const Eigen::Matrix<double, 2, 4> row =
            e.gradient(0, a) * H.topRows<2>() + e.gradient(1, a) * H.bottomRows<2>();
        for (int b = 0; b < 3; ++b)
            K.block<2, 2>(2 * a, 2 * b) = e.gradient(0, b) * row.leftCols<2>() + e.gradient(1, b) * row.rightCols<2>();
    }
    for (int k = 0; k < 9 && e.metric; ++k) {
        auto block = K.block<2, 2>(2 * (k / 3), 2 * (k % 3));
        block = (*e.metric * block * *e.metric).eval();
    }
    return K;
}

double energy_density_value(const MembraneLaw& law, const Eigen::Matrix2d& G)
{
    // Singular values alone: no singular vectors, no trigonometry.
    const double e = G(0, 0) + G(1, 1), f = G(0, 0) - G(1, 1), g = G(1, 0) + G(0, 1), h = G(1, 0) - G(0, 1);
    const double s1 = 0.5 * (std::sqrt(e * e + h * h) + std::sqrt(f * f + g * g));
    return law({-std::log(s1), -std::log(G.determinant() / s1)}).work;
}

EnergyDensity energy_density(const MembraneLaw& law, const Eigen::Matrix2d& G, const ElementStress& expected)
{
    const Svd2 d = svd(G);
    const Eigen::Vector2d& s = d.s;
    const AxisStress p = law.normal(-s.array().log().matrix());

    // The strain in the axes V, engineering shear, changes with M = U^T dG V: columns M_11, M_22,
    // M_12, M_21.
    const double q = log_difference_quotient(s[0] * s[0], s[1] * s[1]);
    Eigen::Matrix<double, 3, 4> strain;
    strain << -1 / s[0], 0, 0, 0, 0, -1 / s[1], 0, 0, 0, 0, -q * s[0], -q * s[1];
    Eigen::Matrix4d H = strain.transpose() * stabilized_tangent(p, d, expected) * strain;
    // The rest of the second derivative, stress times the strain's. The mixed directions M_12 -
    // M_21 (twist) and M_12 + M_21 (flip) have closed eigenvalues [Smith et al. 2019]; what the
    // shear modulus adds to them above is taken off again.
    const Eigen::Vector2d first = -p.stress.head<2>().cwiseQuotient(s); // d W / d s
    const double shear = p.secant * p.metric(2, 2);
    const double twist = (first[0] + first[1]) / (s[0] + s[1]);
    const double stress_per_stretch = -2 * shear * log_difference_quotient(s[0], s[1]);
    const double flip = (0.5 * (p.stress[0] + p.stress[1]) - stress_per_stretch * 0.5 * (s[0] + s[1])) / (s[0] * s[1]);
    H(0, 0) += p.stress[0] / (s[0] * s[0]);
    H(1, 1) += p.stress[1] / (s[1] * s[1]);
    H(2, 2) += 0.5 * (twist + flip) - shear * q * q * s[0] * s[0];
    H(3, 3) += 0.5 * (twist + flip) - shear * q * q * s[1] * s[1];
    H(2, 3) += 0.5 * (flip - twist) - shear * q * q * s[0] * s[1];
    H(3, 2) = H(2, 3);
    const double floor = 2e-8 * shear / (s[0] * s[0]);
    if (Eigen::LLT<Eigen::Matrix4d>(H - floor * Eigen::Matrix4d::Identity()).info() != Eigen::Success)
        H = with_least_eigenvalue(H, floor);
    const Eigen::Matrix4d basis = singular_basis(d);

    EnergyDensity out;
    out.value = p.work;
    out.gradient = d.U * first.asDiagonal() * d.V.transpose();
    out.stiffness = basis * H * basis.transpose();
    return out;
}

Eigen::Matrix2d membrane_force_value(const MembraneLaw& law, double h0, const Eigen::Matrix2d& G)
{
    const Svd2 d = svd(G);
    const AxisStress p = law(d.U, -d.s.array().log().matrix());
    Eigen::Matrix2d principal;
    principal << p.stress[0], p.stress[2], p.stress[2], p.stress[1];
    return h0 * d.s[0] * d.s[1] * (d.V * principal * d.V.transpose());
}

MembraneForce membrane_force(const MembraneLaw& law, double h0, const Eigen::Matrix2d& G, const ElementStress* expected)
{
    // With M = U^T dG V and U^T dU, V^T dV the spins of the singular vectors:
    //   strain in the axes U: d eps_k = -M_kk / s_k, 2 d eps_12 = -q (s_2 M_12 + s_1 M_21),
    //   q = ln(s_1^2/s_2^2) / (s_1^2 - s_2^2),
    //   spin of V against U: (M_12 - M_21) / (s_1 + s_2),
    // both without a pole at s_1 = s_2.
    const Svd2 d = svd(G);
    const Eigen::Vector2d& s = d.s;
    const AxisStress p = law(d.U, -s.array().log().matrix());
    const Eigen::Matrix3d tangent = expected ? stabilized_tangent(p, d, *expected) : p.tangent;
    const double h = h0 * s[0] * s[1];
    const double q = log_difference_quotient(s[0] * s[0], s[1] * s[1]);
    Eigen::Matrix<double, 3, 4> strain; // columns: M_11, M_22, M_12, M_21
    strain << -1 / s[0], 0, 0, 0, 0, -1 / s[1], 0, 0, 0, 0, -q * s[1], -q * s[0];
    const Eigen::RowVector4d stretch(1 / s[0], 1 / s[1], 0, 0); // dh / h
    const double spin = 1 / (s[0] + s[1]);
    const Eigen::Vector3d turned(-2 * p.stress[2], 2 * p.stress[2], p.stress[0] - p.stress[1]);
    Eigen::Matrix<double, 3, 4> in_basis = h * (tangent * strain + p.stress * stretch);
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
