#include "engine/forming/equilibrium.h"

#include <Eigen/Dense>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/mesh/topology.h"
#include "engine/sparse/gmres.h"
#include "engine/sparse/lu.h"

namespace spia {
namespace {

using Axes = Eigen::Matrix<double, 3, 2>;

/// The smallest rotation that takes unit vector `from` to unit vector `to`, applied to v. Where they are opposite
/// (a sheet folded flat on itself) the turn is not unique; the guarded divisor then picks none in particular.
Eigen::Vector3d turn(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& v)
{
    const Eigen::Vector3d w = from.cross(to);
    const double divisor = std::max(1 + from.dot(to), 1e-6);
    return v + w.cross(v) + w.cross(w.cross(v)) / divisor;
}

/// What the equations need besides X: for each corner the 2 x 2 map from the triangle's plane to the axes of its node,
/// and the node's axes themselves.
struct NodeFrames {
    std::vector<std::array<Eigen::Matrix2d, 3>> to_node; ///< T_a^T Q_ea J_e
    std::vector<Axes> axes;                              ///< T_a: push-forward of the blank's x and y, tangential
};

/// Axes that follow the blank's x and y through the deformation make the tangent matrix nearly symmetric: the residual is
/// then close to the gradient of the energy. Any other choice gives the same solution.
NodeFrames node_frames(const TriMesh& part, const std::vector<Element>& element, const Eigen::Matrix2Xd& X)
{
    const Eigen::Matrix3Xd normal = vertex_normals(part);
    NodeFrames frames;
    frames.axes.assign(size_t(part.vertices()), Axes::Zero());
    frames.to_node.resize(element.size());
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(part.vertices());
    std::vector<std::array<Axes, 3>> turned(element.size()); // Q_ea J_e
    for (int f = 0; f < part.triangles(); ++f) {
        const Element& e = element[size_t(f)];
        const Eigen::Vector3d face_normal = e.frame.col(0).cross(e.frame.col(1));
        const Eigen::Matrix2d F = inverse_gradient(e, corners(X, part.triangle.col(f))).inverse();
        for (int a = 0; a < 3; ++a) {
            const int v = part.triangle(a, f);
            Axes& QJ = turned[size_t(f)][size_t(a)];
            for (int k = 0; k < 2; ++k)
                QJ.col(k) = turn(face_normal, normal.col(v), e.frame.col(k));
            frames.axes[size_t(v)] += e.area * QJ * F;
            weight[v] += e.area;
        }
    }
    for (int v = 0; v < part.vertices(); ++v)
        frames.axes[size_t(v)] /= weight[v];
    for (int f = 0; f < part.triangles(); ++f)
        for (int a = 0; a < 3; ++a)
            frames.to_node[size_t(f)][size_t(a)] =
                frames.axes[size_t(part.triangle(a, f))].transpose() * turned[size_t(f)][size_t(a)];
    return frames;
}

/// Nodal friction force in the node's axes and its derivative with respect to X_a.
struct NodalFriction {
    Eigen::Vector2d force;
    Eigen::Matrix2d derivative;
};

class System {
public:
    System(const TriMesh& part, const std::vector<Element>& element, const MembraneLaw& law, double h0,
           const Friction& friction, NodeFrames frames)
        : part_(part), element_(element), law_(law), h0_(h0), friction_(friction), frames_(std::move(frames)),
          normal_(vertex_normals(part))
    {
        if (friction.traction.size() == 0)
            return;
        nodal_traction_ = Eigen::VectorXd::Zero(part.vertices());
        for (int f = 0; f < part.triangles(); ++f)
            for (int a = 0; a < 3; ++a)
                nodal_traction_[part.triangle(a, f)] += friction.traction[f] * element[size_t(f)].area / 3;
    }

    /// Minus internal plus external forces: its derivative with respect to X is nearly positive definite.
    Eigen::VectorXd residual(const Eigen::Matrix2Xd& X) const
    {
        std::vector<Eigen::Matrix<double, 2, 3>> force(element_.size());
        parallel_for(part_.triangles(), [&](int f) {
            const Element& e = element_[size_t(f)];
            const Eigen::Matrix2d tau =
                membrane_force(law_, h0_, inverse_gradient(e, corners(X, part_.triangle.col(f)))).force;
            for (int a = 0; a < 3; ++a)
                force[size_t(f)].col(a) =
                    -e.area * (frames_.to_node[size_t(f)][size_t(a)] * (tau * e.gradient.col(a)));
        });
        Eigen::VectorXd R = Eigen::VectorXd::Zero(2 * X.cols());
        for (int f = 0; f < part_.triangles(); ++f)
            for (int a = 0; a < 3; ++a)
                R.segment<2>(2 * part_.triangle(a, f)) += force[size_t(f)].col(a);
        if (nodal_traction_.size() > 0)
            for (int v = 0; v < part_.vertices(); ++v)
                R.segment<2>(2 * v) += nodal_friction(v, X.col(v)).force;
        return R;
    }

    void tangent(const Eigen::Matrix2Xd& X, BlockMatrix& matrix) const
    {
        std::vector<Matrix6d> stiffness(element_.size());
        parallel_for(part_.triangles(), [&](int f) {
            const Element& e = element_[size_t(f)];
            const MembraneForce m = membrane_force(law_, h0_, inverse_gradient(e, corners(X, part_.triangle.col(f))));
            for (int b = 0; b < 3; ++b)
                for (int k = 0; k < 2; ++k) {
                    // dG = unit vector k times g_b^T
                    const Eigen::Vector4d d =
                        m.derivative.col(k) * e.gradient(0, b) + m.derivative.col(2 + k) * e.gradient(1, b);
                    const Eigen::Matrix2d dtau = d.reshaped(2, 2);
                    for (int a = 0; a < 3; ++a)
                        stiffness[size_t(f)].block<2, 1>(2 * a, 2 * b + k) =
                            -e.area * (frames_.to_node[size_t(f)][size_t(a)] * (dtau * e.gradient.col(a)));
                }
        });
        matrix.assemble(stiffness);
        if (nodal_traction_.size() > 0)
            for (int v = 0; v < part_.vertices(); ++v)
                matrix.add_to_diagonal(v, nodal_friction(v, X.col(v)).derivative);
    }

    /// Forces of a sheet at its yield stress all over: what |R| is measured against.
    double reference() const
    {
        Eigen::VectorXd force = Eigen::VectorXd::Zero(part_.vertices());
        for (int f = 0; f < part_.triangles(); ++f)
            for (int a = 0; a < 3; ++a)
                force[part_.triangle(a, f)] += element_[size_t(f)].area * h0_ * law_.curve().yield_stress() *
                                               element_[size_t(f)].gradient.col(a).norm();
        return force.norm();
    }

private:
    NodalFriction nodal_friction(int v, const Eigen::Vector2d& X) const
    {
        NodalFriction out{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
        if (nodal_traction_[v] == 0)
            return out;
        const Eigen::Vector3d n = normal_.col(v);
        const Eigen::Matrix3d to_tangent = Eigen::Matrix3d::Identity() - n * n.transpose();
        const Eigen::Vector3d slip =
            to_tangent * (part_.position.col(v) - friction_.origin - friction_.plane * X);
        const double length = std::sqrt(slip.squaredNorm() + friction_.full_slip * friction_.full_slip);
        const Eigen::Matrix3d change =
            (Eigen::Matrix3d::Identity() - slip * slip.transpose() / (length * length)) / length;
        const Axes& T = frames_.axes[size_t(v)];
        out.force = -nodal_traction_[v] * (T.transpose() * slip) / length;
        out.derivative = nodal_traction_[v] * T.transpose() * change * to_tangent * friction_.plane;
        return out;
    }

    const TriMesh& part_;
    const std::vector<Element>& element_;
    const MembraneLaw& law_;
    double h0_;
    const Friction& friction_;
    NodeFrames frames_;
    Eigen::Matrix3Xd normal_;
    Eigen::VectorXd nodal_traction_;
};

/// Mean translation and rotation of the blank as three orthonormal rows with area weights.
class RigidMotion {
public:
    RigidMotion(const TriMesh& part, const std::vector<Element>& element, const Eigen::Matrix2Xd& X) : start_(X)
    {
        Eigen::VectorXd mass = Eigen::VectorXd::Zero(part.vertices());
        for (int f = 0; f < part.triangles(); ++f)
            for (int a = 0; a < 3; ++a)
                mass[part.triangle(a, f)] += element[size_t(f)].area / 3;
        const Eigen::Vector2d centre = X * mass / mass.sum();
        rows_.setZero(2 * X.cols(), 3);
        for (int v = 0; v < part.vertices(); ++v) {
            const Eigen::Vector2d arm = X.col(v) - centre;
            rows_.block<2, 3>(2 * v, 0) << mass[v], 0, -mass[v] * arm[1], 0, mass[v], mass[v] * arm[0];
        }
        for (int k = 0; k < 3; ++k)
            rows_.col(k).normalize();
    }

    const Eigen::MatrixX3d& rows() const { return rows_; }
    Eigen::Vector3d moved(const Eigen::Matrix2Xd& X) const { return rows_.transpose() * (X - start_).reshaped(); }

private:
    Eigen::Matrix2Xd start_;
    Eigen::MatrixX3d rows_;
};

/// Solves (K + k C C^T) d = -R: the exact tangent with the three soft springs on the rigid motion. A Cholesky factor of the
/// symmetric part preconditions GMRES; where the symmetric part is not definite, a sparse LU takes its place.
Eigen::VectorXd newton_direction(const BlockMatrix& K, const RigidMotion& rigid, double spring, const Eigen::VectorXd& R,
                                 double tolerance, Cholesky& cholesky)
{
    const LinearMap A = [&](const Eigen::VectorXd& x) {
        Eigen::VectorXd y;
        K.multiply(x, y);
        return Eigen::VectorXd(y + rigid.rows() * (spring * (rigid.rows().transpose() * x)));
    };
    constexpr int most_iterations = 60;
    BlockMatrix S = K.symmetric_part();
    const double mean = S.diagonal().mean();
    // The preconditioner holds the rigid motion at two vertices: GMRES takes the difference to the springs, of rank six.
    S.add_to_diagonal(0, mean);
    S.add_to_diagonal(1, mean);
    S.add_to_diagonal(S.size() - 1, mean);
    if (cholesky.factor(S)) {
        const GmresResult solved =
            gmres(A, [&](const Eigen::VectorXd& x) { return cholesky.solve(x); }, -R, tolerance, most_iterations);
        if (solved.relative_residual <= tolerance)
            return solved.x;
    }
    BlockMatrix pinned = K;
    pinned.add_to_diagonal(0, mean);
    pinned.add_to_diagonal(1, mean);
    pinned.add_to_diagonal(K.size() - 1, mean);
    const Lu lu(pinned);
    return gmres(A, [&](const Eigen::VectorXd& x) { return lu.solve(x); }, -R, tolerance, most_iterations).x;
}

} // namespace

EquilibriumSystem equilibrium_system(const TriMesh& part, const MembraneLaw& law, double h0, const Friction& friction,
                                     const Eigen::Matrix2Xd& axes_at, const Eigen::Matrix2Xd& X)
{
    const auto element = elements(part);
    const System system(part, element, law, h0, friction, node_frames(part, element, axes_at));
    EquilibriumSystem result{system.residual(X), BlockMatrix(part.triangle, part.vertices())};
    system.tangent(X, result.tangent);
    return result;
}

EquilibriumResult solve_equilibrium(const TriMesh& part, const std::vector<Element>& element, const MembraneLaw& law,
                                    double h0, const Friction& friction, const Eigen::Matrix2Xd& start,
                                    BlockMatrix& matrix, Cholesky& cholesky, const EquilibriumOptions& options,
                                    const Progress& progress)
{
    const System system(part, element, law, h0, friction, node_frames(part, element, start));
    const RigidMotion rigid(part, element, start);
    const double reference = system.reference();
    EquilibriumResult result;
    result.position = start;
    Eigen::Matrix2Xd& X = result.position;
    double spring = 0;
    const auto total = [&](const Eigen::Matrix2Xd& at) {
        return Eigen::VectorXd(system.residual(at) + rigid.rows() * (spring * rigid.moved(at)));
    };
    Eigen::VectorXd R = total(X);
    for (int step = 0; step <= options.most_steps; ++step) {
        progress.checkpoint(double(step) / options.most_steps, "equilibrium step");
        result.residual = R.norm() / reference;
        result.resultant = spring * rigid.moved(X);
        result.steps.push_back({0, result.residual, 0});
        if (result.residual <= options.tolerance) {
            result.ended = Ended::converged;
            return result;
        }
        if (step == options.most_steps)
            break;
        system.tangent(X, matrix);
        if (step == 0) {
            spring = matrix.diagonal().mean();
            R = total(X);
        }
        // Solve the linear system only as exactly as the quadratic decrease of Newton needs.
        const double tolerance = std::clamp(0.1 * result.residual, 1e-10, 1e-3);
        const Eigen::VectorXd newton = newton_direction(matrix, rigid, spring, R, tolerance, cholesky);
        const Eigen::Map<const Eigen::Matrix2Xd> direction(newton.data(), 2, X.cols());
        double length = std::min(1.0, 0.9 * largest_step(part.triangle, X, direction));
        bool decreased = false;
        for (int halving = 0; halving < 12; ++halving, length *= 0.5) {
            const Eigen::Matrix2Xd trial = X + length * direction;
            const Eigen::VectorXd R_trial = total(trial);
            if (R_trial.norm() <= (1 - 1e-4 * length) * R.norm()) {
                X = trial;
                R = R_trial;
                decreased = true;
                break;
            }
        }
        result.steps.back().step_length = decreased ? length : 0;
        if (!decreased) {
            result.ended = Ended::stalled;
            return result;
        }
    }
    return result;
}

} // namespace spia
