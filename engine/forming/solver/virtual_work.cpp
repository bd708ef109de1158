#include "engine/forming/solver/virtual_work.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/core/small_dense.h"
#include "engine/forming/process/smallest_turn.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// The symmetric part with its negative eigenvalues left out.
Eigen::Matrix2d definite(const Eigen::Matrix2d& K)
{
    return with_least_eigenvalue(Eigen::Matrix2d(0.5 * (K + K.transpose())), 0);
}

/// Of symmetric K, with the eigenvalues by their size. [Cayley and Hamilton: |K| = (K^2 + |det K|)
/// / tr |K|]
Eigen::Matrix2d magnitude(const Eigen::Matrix2d& K)
{
    const Eigen::Matrix2d square = K * K;
    const double determinant = std::abs(K.determinant()), trace = std::sqrt(square.trace() + 2 * determinant);
    return trace > 0 ? Eigen::Matrix2d((square + determinant * Eigen::Matrix2d::Identity()) / trace)
                     : Eigen::Matrix2d::Zero();
}

/// A symmetric 4 by 4 tangent over the entries of G, column by column, with the eigenvalues by
/// their size. In the principal axes of G the changes of its singular values have nothing to do
/// with shear and rotation; how planar anisotropy couples them is left out.
Eigen::Matrix4d definite(const Eigen::Matrix4d& K, const Svd2& G)
{
    constexpr double least = 1e-8; // of the trace, so that nothing is left without stiffness
    Eigen::Matrix4d axes;          // columns: stretches, then the entries off the diagonal
    for (int k = 0; k < 4; ++k) {
        const int i = k == 1 || k == 2, j = k == 1 || k == 3;
        axes.col(k) = (G.U.col(i) * G.V.col(j).transpose()).reshaped();
    }
    const Eigen::Matrix4d principal = axes.transpose() * K * axes;
    Eigen::Matrix4d magnitudes = Eigen::Matrix4d::Zero();
    magnitudes.topLeftCorner<2, 2>() = magnitude(principal.topLeftCorner<2, 2>());
    magnitudes.bottomRightCorner<2, 2>() = magnitude(principal.bottomRightCorner<2, 2>());
    magnitudes.diagonal().array() += least * magnitudes.trace();
    return axes * magnitudes * axes.transpose();
}

/// Change of M (h sigma) g with G, column by column.
/// @param pull_back F^T
/// @param relaxed   share in which M is F^T, or that seen in the blank's coordinates, and changes
///         with G
Eigen::Matrix<double, 2, 4> force_change(const MembraneForce& m, const Eigen::Matrix2d& pull_back,
                                         const Eigen::Matrix2d& M, double relaxed, const Eigen::Vector2d& g)
{
    Eigen::Matrix<double, 2, 4> change = M * (g[0] * m.derivative.topRows<2>() + g[1] * m.derivative.bottomRows<2>());
    if (relaxed > 0) { // dF^T = -F^T dG^T F^T, and dG has a single one in row k % 2, column k / 2
        const Eigen::Vector2d pulled = relaxed * (pull_back * (m.force * g));
        for (int k = 0; k < 4; ++k)
            change.col(k) -= M.col(k / 2) * pulled[k % 2];
    }
    return change;
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
                    smallest_turn(face_normal, normal_.col(part.triangle(a, f)), frame.col(k));
    }
}

void VirtualWork::set_axes(const Eigen::Matrix2Xd& X)
{
    std::fill(axes_.begin(), axes_.end(), Axes::Zero());
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(part_.vertices());
    for (int f = 0; f < part_.triangles(); ++f) {
        const Element& e = element_[size_t(f)];
        F_[size_t(f)] = inverse_gradient(e, corners(X, part_.triangle.col(f))).inverse();
        if (e.metric)
            F_[size_t(f)] *= *e.metric;
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
            // The triangle's push-forward of the blank's axes, in terms of the vertex's: the
            // identity if they agree.
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

VirtualWork::Formed VirtualWork::formed(int f, const Eigen::Matrix2Xd& X, bool stabilized) const
{
    const Eigen::Matrix2d G = inverse_gradient(element_[size_t(f)], corners(X, part_.triangle.col(f)));
    const ElementStress* expected = stabilized && !expected_.empty() ? &expected_[size_t(f)] : nullptr;
    return {membrane_force(sheet_.law_of(f), sheet_.thickness[f], G, expected), G.inverse().transpose()};
}

void VirtualWork::stabilize(const Eigen::Matrix2Xd& X)
{
    expected_.assign(element_.size(), ElementStress::Zero());
    expect(X, Eigen::Matrix2Xd::Zero(2, X.cols())); // of no step at all: the stress that is there
}

void VirtualWork::expect(const Eigen::Matrix2Xd& X, const Eigen::Matrix2Xd& step)
{
    parallel_for(int(expected_.size()), [&](int f) {
        const Element& e = element_[size_t(f)];
        const Svd2 d = svd(inverse_gradient(e, corners(X, part_.triangle.col(f))));
        const Eigen::Matrix2d change = inverse_gradient(e, corners(step, part_.triangle.col(f)));
        expected_[size_t(f)] = expected_stress(stress(f, d), d, change, expected_[size_t(f)]);
    });
}

Eigen::Matrix2d VirtualWork::to_vertex(int f, int a, const Eigen::Matrix2d& pull_back) const
{
    const size_t v = size_t(part_.triangle(a, f));
    if (!relaxed_[v])
        return axes_[v].transpose() * turned_[size_t(f)][size_t(a)];
    const Element& e = element_[size_t(f)];
    return e.metric ? Eigen::Matrix2d(*e.metric * pull_back) : pull_back;
}

Eigen::VectorXd VirtualWork::residual(const Eigen::Matrix2Xd& X) const
{
    Eigen::VectorXd R = Eigen::VectorXd::Zero(2 * X.cols());
    parallel_in_order<Eigen::Matrix<double, 2, 3>>(
        part_.triangles(),
        [&](int f, Eigen::Matrix<double, 2, 3>& force) {
            const Element& e = element_[size_t(f)];
            const Eigen::Matrix2d G = inverse_gradient(e, corners(X, part_.triangle.col(f))),
                                  pull_back = G.inverse().transpose();
            const Eigen::Matrix<double, 2, 3> out =
                -e.area * (membrane_force_value(sheet_.law_of(f), sheet_.thickness[f], G) * e.gradient);
            for (int a = 0; a < 3; ++a)
                force.col(a) = to_vertex(f, a, pull_back) * out.col(a);
        },
        [&](int f, const Eigen::Matrix<double, 2, 3>& force) {
            for (int a = 0; a < 3; ++a)
                R.segment<2>(2 * part_.triangle(a, f)) += force.col(a);
        });
    for (int v = 0; v < part_.vertices(); ++v)
        if (nodal_.acts_on(v))
            R.segment<2>(2 * v) += axes_[size_t(v)].transpose() * nodal_(v, X.col(v)).force;
    for (const HeldVertex& h : external_.held)
        R.segment<2>(2 * h.vertex) = hold_ * (X.col(h.vertex) - h.place);
    return R;
}

void VirtualWork::tangent(const Eigen::Matrix2Xd& X, BlockMatrix& matrix) const
{
    matrix.clear();
    parallel_in_order<Matrix6d>(
        part_.triangles(), [&](int f, Matrix6d& K) { K = element_tangent(f, formed(f, X, true)); },
        [&](int f, const Matrix6d& K) { matrix.add(f, K); });
    add_external_tangent(X, matrix);
}

void VirtualWork::tangents(const Eigen::Matrix2Xd& X, BlockMatrix& tangent, BlockMatrix& definite_neighbour) const
{
    struct Contribution {
        Matrix6d exact, definite;
    };
    tangent.clear();
    definite_neighbour.clear();
    parallel_in_order<Contribution>(
        part_.triangles(),
        [&](int f, Contribution& out) {
            const Formed at = formed(f, X, true);
            out.exact = element_tangent(f, at);
            out.definite = definite_element(f, at);
        },
        [&](int f, const Contribution& in) {
            tangent.add(f, in.exact);
            definite_neighbour.add(f, in.definite);
        });
    add_external_tangent(X, tangent);
    for (int v = 0; v < part_.vertices(); ++v)
        if (nodal_.acts_on(v) && held_[size_t(v)] < 0)
            definite_neighbour.add_to_diagonal(v,
                                               definite(axes_[size_t(v)].transpose() * nodal_(v, X.col(v)).derivative));
    for (const HeldVertex& h : external_.held)
        definite_neighbour.add_to_diagonal(h.vertex, hold_ * Eigen::Matrix2d::Identity());
    // Two vertices hold the rigid motion; the springs that really do are left to GMRES: a
    // difference of rank six.
    const double mean = definite_neighbour.diagonal().mean();
    definite_neighbour.add_to_diagonal(0, mean);
    definite_neighbour.add_to_diagonal(1, mean);
    definite_neighbour.add_to_diagonal(definite_neighbour.size() - 1, mean);
}

void VirtualWork::add_external_tangent(const Eigen::Matrix2Xd& X, BlockMatrix& matrix) const
{
    for (int v = 0; v < part_.vertices(); ++v)
        if (nodal_.acts_on(v) && held_[size_t(v)] < 0)
            matrix.add_to_diagonal(v, axes_[size_t(v)].transpose() * nodal_(v, X.col(v)).derivative);
    for (const HeldVertex& h : external_.held)
        matrix.add_to_diagonal(h.vertex, hold_ * Eigen::Matrix2d::Identity());
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

Matrix6d VirtualWork::element_tangent(int f, const Formed& at) const
{
    const Element& e = element_[size_t(f)];
    Matrix6d K;
    for (int a = 0; a < 3; ++a) {
        const size_t v = size_t(part_.triangle(a, f));
        if (held_[v] >= 0) {
            K.middleRows<2>(2 * a).setZero();
            continue;
        }
        const Eigen::Matrix<double, 2, 4> change =
            -e.area * force_change(at.m, at.pull_back, to_vertex(f, a, at.pull_back), relaxed_[v], e.gradient.col(a));
        for (int b = 0; b < 3; ++b)
            K.block<2, 2>(2 * a, 2 * b) =
                change.leftCols<2>() * e.gradient(0, b) + change.rightCols<2>() * e.gradient(1, b);
        for (int b = 0; b < 3 && e.metric; ++b)
            K.block<2, 2>(2 * a, 2 * b) *= *e.metric;
    }
    return K;
}

Matrix6d VirtualWork::definite_element(int f, const Formed& at) const
{
    const Element& e = element_[size_t(f)];
    double relaxed = 0;
    for (int a = 0; a < 3; ++a)
        relaxed += relaxed_[size_t(part_.triangle(a, f))] / 3.0;
    // With the triangle's own push-forward of the axes for those of its vertices.
    Eigen::Matrix4d K;
    K << force_change(at.m, at.pull_back, at.pull_back, relaxed, Eigen::Vector2d::UnitX()),
        force_change(at.m, at.pull_back, at.pull_back, relaxed, Eigen::Vector2d::UnitY());
    K = definite(Eigen::Matrix4d(-0.5 * (K + K.transpose())), svd(at.pull_back));
    Matrix6d out = element_stiffness(e, e.area * K);
    for (int a = 0; a < 3; ++a)
        if (held_[size_t(part_.triangle(a, f))] >= 0) {
            out.middleRows<2>(2 * a).setZero();
            out.middleCols<2>(2 * a).setZero();
        }
    return out;
}

} // namespace spia
