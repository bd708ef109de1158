#include "engine/forming/virtual_work.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// The smallest rotation that takes unit vector `from` to unit vector `to`, applied to v. Where they are opposite
/// (a sheet folded flat on itself) the turn is not unique; the guarded divisor then picks none in particular.
Eigen::Vector3d turn(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& v)
{
    const Eigen::Vector3d w = from.cross(to);
    const double divisor = std::max(1 + from.dot(to), 1e-6);
    return v + w.cross(v) + w.cross(w.cross(v)) / divisor;
}

/// The symmetric part with its negative eigenvalues left out.
Eigen::Matrix2d definite(const Eigen::Matrix2d& K)
{
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> modes(0.5 * (K + K.transpose()));
    return modes.eigenvectors() * modes.eigenvalues().cwiseMax(0).asDiagonal() * modes.eigenvectors().transpose();
}

Eigen::VectorXd areas(const std::vector<Element>& element)
{
    Eigen::VectorXd area(Eigen::Index(element.size()));
    for (size_t f = 0; f < element.size(); ++f)
        area[Eigen::Index(f)] = element[f].area;
    return area;
}

} // namespace

VirtualWork::VirtualWork(const TriMesh& part, const std::vector<Element>& element, const Sheet& sheet,
                         const ExternalForces& external)
    : part_(part), element_(element), sheet_(sheet), external_(external), normal_(vertex_normals(part)),
      nodal_(external, part.position, normal_, part.triangle, areas(element)), held_(size_t(part.vertices()), -1),
      turned_(element.size()), F_(element.size()), axes_(size_t(part.vertices())), relaxed_(size_t(part.vertices()), 0)
{
    for (size_t k = 0; k < external.held.size(); ++k)
        held_[size_t(external.held[k].vertex)] = int(k);
    hold_ = sheet.thickness.mean() * sheet.law.front().young();
    for (int f = 0; f < part.triangles(); ++f) {
        const auto& frame = element[size_t(f)].frame;
        const Eigen::Vector3d face_normal = frame.col(0).cross(frame.col(1));
        for (int a = 0; a < 3; ++a)
            for (int k = 0; k < 2; ++k)
                turned_[size_t(f)][size_t(a)].col(k) =
                    turn(face_normal, normal_.col(part.triangle(a, f)), frame.col(k));
    }
}

void VirtualWork::set_axes(const Eigen::Matrix2Xd& X)
{
    std::fill(axes_.begin(), axes_.end(), Axes::Zero());
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(part_.vertices());
    for (int f = 0; f < part_.triangles(); ++f) {
        const Element& e = element_[size_t(f)];
        F_[size_t(f)] = inverse_gradient(e, corners(X, part_.triangle.col(f))).inverse();
        for (int a = 0; a < 3; ++a) {
            const int v = part_.triangle(a, f);
            axes_[size_t(v)] += e.area * turned_[size_t(f)][size_t(a)] * F_[size_t(f)];
            weight[v] += e.area;
        }
    }
    for (int v = 0; v < part_.vertices(); ++v)
        axes_[size_t(v)] /= weight[v];
}

Eigen::VectorXd VirtualWork::mismatch() const
{
    constexpr double least_cosine = 0.5;
    Eigen::VectorXd worst = Eigen::VectorXd::Ones(part_.vertices());
    for (int f = 0; f < part_.triangles(); ++f)
        for (int a = 0; a < 3; ++a) {
            const int v = part_.triangle(a, f);
            const Axes& T = axes_[size_t(v)];
            const auto& frame = element_[size_t(f)].frame;
            // The triangle's push-forward of the blank's axes, in terms of the vertex's: the identity if they agree.
            const Eigen::Matrix2d relative =
                (T.transpose() * T).inverse() * T.transpose() * turned_[size_t(f)][size_t(a)] * F_[size_t(f)];
            const Eigen::Vector2d s = svd(relative).s;
            const bool tangent_plane = frame.col(0).cross(frame.col(1)).dot(normal_.col(v)) >= least_cosine;
            if (!tangent_plane || !(s[1] > 0))
                worst[v] = std::numeric_limits<double>::infinity();
            else
                worst[v] = std::max({worst[v], s[0], 1 / s[1]});
        }
    return worst;
}

VirtualWork::Formed VirtualWork::formed(int f, const Eigen::Matrix2Xd& X) const
{
    const Eigen::Matrix2d G = inverse_gradient(element_[size_t(f)], corners(X, part_.triangle.col(f)));
    return {membrane_force(sheet_.law_of(f), sheet_.thickness[f], G), G.inverse().transpose()};
}

Eigen::Matrix2d VirtualWork::to_vertex(int f, int a, const Eigen::Matrix2d& pull_back) const
{
    const size_t v = size_t(part_.triangle(a, f));
    return relaxed_[v] ? pull_back : Eigen::Matrix2d(axes_[v].transpose() * turned_[size_t(f)][size_t(a)]);
}

Eigen::VectorXd VirtualWork::residual(const Eigen::Matrix2Xd& X) const
{
    std::vector<Eigen::Matrix<double, 2, 3>> force(element_.size());
    parallel_for(part_.triangles(), [&](int f) {
        const Element& e = element_[size_t(f)];
        const auto [m, pull_back] = formed(f, X);
        for (int a = 0; a < 3; ++a)
            force[size_t(f)].col(a) = -e.area * (to_vertex(f, a, pull_back) * (m.force * e.gradient.col(a)));
    });
    Eigen::VectorXd R = Eigen::VectorXd::Zero(2 * X.cols());
    for (int f = 0; f < part_.triangles(); ++f)
        for (int a = 0; a < 3; ++a)
            R.segment<2>(2 * part_.triangle(a, f)) += force[size_t(f)].col(a);
    for (int v = 0; v < part_.vertices(); ++v)
        if (nodal_.acts_on(v))
            R.segment<2>(2 * v) += axes_[size_t(v)].transpose() * nodal_(v, X.col(v)).force;
    for (const HeldVertex& h : external_.held)
        R.segment<2>(2 * h.vertex) = hold_ * (X.col(h.vertex) - h.place);
    return R;
}

void VirtualWork::tangent(const Eigen::Matrix2Xd& X, BlockMatrix& matrix) const
{
    std::vector<Matrix6d> stiffness(element_.size());
    parallel_for(part_.triangles(), [&](int f) {
        const Element& e = element_[size_t(f)];
        const auto [m, pull_back] = formed(f, X);
        const Eigen::Matrix<double, 4, 6> B = gradient_operator(e);
        for (int a = 0; a < 3; ++a)
            stiffness[size_t(f)].middleRows<2>(2 * a) =
                -e.area * (force_change(m, pull_back, to_vertex(f, a, pull_back),
                                        relaxed_[size_t(part_.triangle(a, f))], e.gradient.col(a)) *
                           B);
        for (int a = 0; a < 3; ++a)
            if (held_[size_t(part_.triangle(a, f))] >= 0)
                stiffness[size_t(f)].middleRows<2>(2 * a).setZero();
    });
    matrix.assemble(stiffness);
    for (int v = 0; v < part_.vertices(); ++v)
        if (nodal_.acts_on(v) && held_[size_t(v)] < 0)
            matrix.add_to_diagonal(v, axes_[size_t(v)].transpose() * nodal_(v, X.col(v)).derivative);
    for (const HeldVertex& h : external_.held)
        matrix.add_to_diagonal(h.vertex, hold_ * Eigen::Matrix2d::Identity());
}

void VirtualWork::definite_tangent(const Eigen::Matrix2Xd& X, BlockMatrix& matrix) const
{
    std::vector<Matrix6d> stiffness(element_.size());
    parallel_for(part_.triangles(), [&](int f) {
        const Element& e = element_[size_t(f)];
        const auto [m, pull_back] = formed(f, X);
        Eigen::Matrix4d K = Eigen::Matrix4d::Zero(); // mean of the three corners
        for (int a = 0; a < 3; ++a) {
            const Eigen::Matrix2d M = to_vertex(f, a, pull_back);
            const bool relaxed = relaxed_[size_t(part_.triangle(a, f))];
            K.topRows<2>() -= force_change(m, pull_back, M, relaxed, Eigen::Vector2d::UnitX()) / 3;
            K.bottomRows<2>() -= force_change(m, pull_back, M, relaxed, Eigen::Vector2d::UnitY()) / 3;
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> modes(0.5 * (K + K.transpose()));
        Eigen::Vector4d value = modes.eigenvalues().cwiseAbs();
        value = value.cwiseMax(1e-8 * value.maxCoeff());
        const Eigen::Matrix<double, 4, 6> B = gradient_operator(e);
        stiffness[size_t(f)] =
            e.area * (B.transpose() * modes.eigenvectors() * value.asDiagonal() * modes.eigenvectors().transpose() * B);
        for (int a = 0; a < 3; ++a)
            if (held_[size_t(part_.triangle(a, f))] >= 0) {
                stiffness[size_t(f)].middleRows<2>(2 * a).setZero();
                stiffness[size_t(f)].middleCols<2>(2 * a).setZero();
            }
    });
    matrix.assemble(stiffness);
    for (int v = 0; v < part_.vertices(); ++v)
        if (nodal_.acts_on(v) && held_[size_t(v)] < 0)
            matrix.add_to_diagonal(v, definite(axes_[size_t(v)].transpose() * nodal_(v, X.col(v)).derivative));
    for (const HeldVertex& h : external_.held)
        matrix.add_to_diagonal(h.vertex, hold_ * Eigen::Matrix2d::Identity());
    // Two vertices hold the rigid motion; the springs that really do are left to GMRES: a difference of rank six.
    const double mean = matrix.diagonal().mean();
    matrix.add_to_diagonal(0, mean);
    matrix.add_to_diagonal(1, mean);
    matrix.add_to_diagonal(matrix.size() - 1, mean);
}

double VirtualWork::yield_force() const
{
    Eigen::VectorXd force = Eigen::VectorXd::Zero(part_.vertices());
    for (int f = 0; f < part_.triangles(); ++f)
        for (int a = 0; a < 3; ++a)
            force[part_.triangle(a, f)] += element_[size_t(f)].area * sheet_.thickness[f] *
                                           sheet_.law_of(f).curve().yield_stress() *
                                           element_[size_t(f)].gradient.col(a).norm();
    return force.norm();
}

Eigen::Matrix<double, 2, 4> VirtualWork::force_change(const MembraneForce& m, const Eigen::Matrix2d& pull_back,
                                                      const Eigen::Matrix2d& M, bool relaxed,
                                                      const Eigen::Vector2d& g) const
{
    Eigen::Matrix<double, 2, 4> change;
    for (int k = 0; k < 4; ++k)
        change.col(k) = M * (m.derivative.col(k).reshaped(2, 2) * g);
    if (relaxed) { // M = F^T: dF^T = -F^T dG^T F^T, and dG has a single one in row k % 2, column k / 2
        const Eigen::Vector2d pulled = pull_back * (m.force * g);
        for (int k = 0; k < 4; ++k)
            change.col(k) -= pull_back.col(k / 2) * pulled[k % 2];
    }
    return change;
}

} // namespace spia
