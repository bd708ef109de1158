#pragma once
#include <optional>
#include <vector>

#include "engine/forming/material/sheet.h"
#include "engine/forming/solver/expected_stress.h"
#include "engine/forming/solver/svd2.h"
#include "engine/mesh/tri_mesh.h"

namespace spia {

/// One triangle of the part in a local frame of its own plane.
struct Element {
    Eigen::Matrix<double, 3, 2> frame;    ///< J: orthonormal axes in the triangle's plane, from 2
                                          ///< to 3 dimensions
    Eigen::Matrix<double, 2, 3> gradient; ///< column a: gradient of corner a's shape function,
                                          ///< 1/mm, in the frame
    double area;                          ///< mm2, of the formed part
    /// Where the blank is told in coordinates that are no lengths, those of a curved face: what
    /// makes them lengths around this triangle, symmetric and positive definite.
    std::optional<Eigen::Matrix2d> metric = {};
};

/// @throws InputError if a face has no area; names it
std::vector<Element> elements(const TriMesh& part);

/// Inverse deformation gradient G = F^-1 = metric * sum over corners of X_a g_a^T. [theory of
/// one-step forming, eqs. 10-12]
Eigen::Matrix2d inverse_gradient(const Element& element, const Eigen::Matrix<double, 2, 3>& blank_corner);

/// The same as a matrix: from the corners (x_0, y_0, x_1, ...) to G, column by column.
Eigen::Matrix<double, 4, 6> gradient_operator(const Element& element);

/// B^T H B with that operator and a 4 x 4 matrix H.
Eigen::Matrix<double, 6, 6> element_stiffness(const Element& element, const Eigen::Matrix4d& H);

/// Corners of a face in the blank.
inline Eigen::Matrix<double, 2, 3> corners(const Eigen::Matrix2Xd& X, const Eigen::Vector3i& face)
{
    Eigen::Matrix<double, 2, 3> result;
    result << X.col(face[0]), X.col(face[1]), X.col(face[2]);
    return result;
}

/// Energy density of forming (integral of sigma_eq d eps_eq, normal anisotropy) as a function of G:
/// value, first derivative, and a positive definite stiffness for descent. It is the second
/// derivative but for two things. Negative eigenvalues are raised to a small positive one; and the
/// tangent of the stress is the stabilized one. With no stress expected the stiffness lies above
/// the work everywhere (which is concave in eps_eq^2), so that full steps descend. [Kacanov 1959;
/// majorise-minimise] G is stored column by column.
struct EnergyDensity {
    double value;              ///< MPa
    Eigen::Matrix2d gradient;  ///< d value / d G
    Eigen::Matrix4d stiffness; ///< symmetric positive definite
};
/// @pre det G > 0
double energy_density_value(const MembraneLaw& law, const Eigen::Matrix2d& G);
EnergyDensity energy_density(const MembraneLaw& law, const Eigen::Matrix2d& G,
                             const ElementStress& expected = ElementStress::Zero());

/// The membrane force h sigma of the formed sheet (N/mm, symmetric, in the frame of the element)
/// and its derivative with respect to G, column by column of G: force.reshaped() changes by
/// derivative * dG.reshaped().
struct MembraneForce {
    Eigen::Matrix2d force;
    Eigen::Matrix4d derivative;
};
/// @pre det G > 0
Eigen::Matrix2d membrane_force_value(const MembraneLaw& law, double h0, const Eigen::Matrix2d& G);
/// @param h0       mm, initial thickness
/// @param expected if given, the derivative has the stabilized tangent of the stress in place of
/// the exact one
MembraneForce membrane_force(const MembraneLaw& law, double h0, const Eigen::Matrix2d& G,
                             const ElementStress* expected = nullptr);

} // namespace spia
