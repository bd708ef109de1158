#include "engine/forming/equilibrium.h"

#include <Eigen/Dense>
#include <cmath>
#include <fmt/core.h>

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

    /// Share of the virtual-work equations; the rest is the gradient of the energy with the thickness held.
    void set_share(double share) { share_ = share; }

    /// Minus internal plus external forces: its derivative with respect to X is nearly positive definite.
    Eigen::VectorXd residual(const Eigen::Matrix2Xd& X) const
    {
        std::vector<Eigen::Matrix<double, 2, 3>> force(element_.size());
        parallel_for(part_.triangles(), [&](int f) {
            const Element& e = element_[size_t(f)];
            const Eigen::Matrix2d G = inverse_gradient(e, corners(X, part_.triangle.col(f)));
            const Eigen::Matrix2d tau = membrane_force(law_, h0_, G, share_).force;
            const Eigen::Matrix2d pull_back = (1 - share_) * G.inverse().transpose();
            for (int a = 0; a < 3; ++a)
                force[size_t(f)].col(a) = -e.area * ((share_ * frames_.to_node[size_t(f)][size_t(a)] + pull_back) *
                                                     (tau * e.gradient.col(a)));
        });
        Eigen::VectorXd R = Eigen::VectorXd::Zero(2 * X.cols());
        for (int f = 0; f < part_.triangles(); ++f)
            for (int a = 0; a < 3; ++a)
                R.segment<2>(2 * part_.triangle(a, f)) += force[size_t(f)].col(a);
        if (nodal_traction_.size() > 0)
            for (int v = 0; v < part_.vertices(); ++v)
                R.segment<2>(2 * v) += share_ * nodal_friction(v, X.col(v)).force;
        return R;
    }

    /// The exact derivative of the residual.
    void tangent(const Eigen::Matrix2Xd& X, BlockMatrix& matrix) const
    {
        std::vector<Matrix6d> stiffness(element_.size());
        parallel_for(part_.triangles(), [&](int f) {
            const Element& e = element_[size_t(f)];
            const Eigen::Matrix2d G = inverse_gradient(e, corners(X, part_.triangle.col(f)));
            const MembraneForce m = membrane_force(law_, h0_, G, share_);
            const Eigen::Matrix<double, 4, 6> B = gradient_operator(e);
            for (int a = 0; a < 3; ++a)
                stiffness[size_t(f)].middleRows<2>(2 * a) =
                    -e.area * (stress_change(m, G, frames_.to_node[size_t(f)][size_t(a)], e.gradient.col(a)) * B);
        });
        matrix.assemble(stiffness);
        if (nodal_traction_.size() > 0)
            for (int v = 0; v < part_.vertices(); ++v)
                matrix.add_to_diagonal(v, share_ * nodal_friction(v, X.col(v)).derivative);
    }

    /// A positive definite neighbour of the tangent, to precondition with: per triangle the symmetric part of the tangent
    /// in the space of G, the eigenvalues by their magnitude (they are negative where the sheet softens).
    void definite_tangent(const Eigen::Matrix2Xd& X, BlockMatrix& matrix) const
    {
        std::vector<Matrix6d> stiffness(element_.size());
        parallel_for(part_.triangles(), [&](int f) {
            const Element& e = element_[size_t(f)];
            const Eigen::Matrix2d G = inverse_gradient(e, corners(X, part_.triangle.col(f)));
            const MembraneForce m = membrane_force(law_, h0_, G, share_);
            const auto& to_node = frames_.to_node[size_t(f)];
            const Eigen::Matrix2d mean_to_node = (to_node[0] + to_node[1] + to_node[2]) / 3;
            Eigen::Matrix4d K;
            K.topRows<2>() = -stress_change(m, G, mean_to_node, Eigen::Vector2d::UnitX());
            K.bottomRows<2>() = -stress_change(m, G, mean_to_node, Eigen::Vector2d::UnitY());
            const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> modes(0.5 * (K + K.transpose()));
            Eigen::Vector4d value = modes.eigenvalues().cwiseAbs();
            value = value.cwiseMax(1e-8 * value.maxCoeff());
            const Eigen::Matrix<double, 4, 6> B = gradient_operator(e);
            stiffness[size_t(f)] = e.area * (B.transpose() * modes.eigenvectors() * value.asDiagonal() *
                                             modes.eigenvectors().transpose() * B);
        });
        matrix.assemble(stiffness);
        // Two vertices hold the rigid motion; the springs that really do are left to GMRES: a difference of rank six.
        const double mean = matrix.diagonal().mean();
        matrix.add_to_diagonal(0, mean);
        matrix.add_to_diagonal(1, mean);
        matrix.add_to_diagonal(matrix.size() - 1, mean);
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
    /// Change of M tau g with G (column by column), M = share * to_node + (1 - share) F^T.
    Eigen::Matrix<double, 2, 4> stress_change(const MembraneForce& m, const Eigen::Matrix2d& G,
                                              const Eigen::Matrix2d& to_node, const Eigen::Vector2d& g) const
    {
        const Eigen::Matrix2d Ft = G.inverse().transpose();
        const Eigen::Matrix2d M = share_ * to_node + (1 - share_) * Ft;
        const Eigen::Vector2d pulled = Ft * (m.force * g);
        Eigen::Matrix<double, 2, 4> change;
        for (int k = 0; k < 4; ++k) {
            change.col(k) = M * (m.derivative.col(k).reshaped(2, 2) * g);
            // dF^T = -F^T dG^T F^T; dG has a single one in row k % 2, column k / 2
            change.col(k) -= (1 - share_) * Ft.col(k / 2) * pulled[k % 2];
        }
        return change;
    }

    NodalFriction nodal_friction(int v, const Eigen::Vector2d& X) const
    {
        NodalFriction out{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
        if (nodal_traction_[v] == 0)
            return out;
        const Eigen::Vector3d n = normal_.col(v);
        const Eigen::Matrix3d to_tangent = Eigen::Matrix3d::Identity() - n * n.transpose();
        const Eigen::Vector3d slip = to_tangent * (part_.position.col(v) - friction_.origin - friction_.plane * X);
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
    double share_ = 1;
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

/// Newton's method with a line search on |R|, for a given share of the virtual-work equations.
class Newton {
public:
    Newton(const TriMesh& part, const std::vector<Element>& element, System& system, const Eigen::Matrix2Xd& start,
           BlockMatrix& tangent, Cholesky& cholesky, const EquilibriumOptions& options, const Progress& progress)
        : triangle_(part.triangle), system_(system), rigid_(part, element, start), tangent_(tangent),
          preconditioner_(tangent), cholesky_(cholesky), options_(options), progress_(progress),
          reference_(system.reference())
    {
        system_.tangent(start, tangent_);
        spring_ = tangent_.diagonal().mean();
    }

    EquilibriumResult solve(const Eigen::Matrix2Xd& start, double share, double tolerance)
    {
        system_.set_share(share);
        EquilibriumResult result;
        result.position = start;
        Eigen::Matrix2Xd& X = result.position;
        Eigen::VectorXd R = residual(X);
        for (int step = 0; step <= options_.most_steps; ++step) {
            result.residual = R.norm() / reference_;
            progress_.checkpoint(double(step) / options_.most_steps,
                                 fmt::format("equilibrium step {}, residual {:.1e}", step + 1, result.residual));
            result.resultant = spring_ * rigid_.moved(X);
            result.steps.push_back({0, result.residual, 0});
            if (result.residual <= tolerance) {
                result.ended = Ended::converged;
                return result;
            }
            if (step == options_.most_steps)
                break;
            if (step >= patience && result.residual > 0.5 * result.steps[size_t(step - patience)].residual) {
                result.ended = Ended::stalled;
                return result;
            }
            const Eigen::VectorXd newton = direction_at(X, R, result.residual);
            const Eigen::Map<const Eigen::Matrix2Xd> direction(newton.data(), 2, X.cols());
            double length = std::min(1.0, 0.9 * largest_step(triangle_, X, direction));
            bool decreased = false;
            for (int halving = 0; halving < 10 && !decreased; ++halving, length *= 0.5) {
                const Eigen::Matrix2Xd trial = X + length * direction;
                const Eigen::VectorXd R_trial = residual(trial);
                if (R_trial.norm() <= (1 - 1e-4 * length) * R.norm()) {
                    X = trial;
                    R = R_trial;
                    result.steps.back().step_length = length;
                    decreased = true;
                }
            }
            if (!decreased) {
                result.ended = Ended::stalled;
                return result;
            }
        }
        return result;
    }

private:
    Eigen::VectorXd residual(const Eigen::Matrix2Xd& X) const
    {
        return system_.residual(X) + rigid_.rows() * (spring_ * rigid_.moved(X));
    }

    /// Solves (K + k C C^T) d = -R, the exact tangent with the three soft springs on the rigid motion, by GMRES. A Cholesky
    /// factor of the tangent's definite neighbour preconditions it; where that is not enough, a sparse LU takes its place.
    Eigen::VectorXd direction_at(const Eigen::Matrix2Xd& X, const Eigen::VectorXd& R, double relative_residual)
    {
        constexpr int most_iterations = 60;
        // Solved only as exactly as Newton's quadratic decrease needs.
        const double tolerance = std::clamp(0.1 * relative_residual, 1e-10, 1e-2);
        system_.tangent(X, tangent_);
        const LinearMap A = [&](const Eigen::VectorXd& x) {
            Eigen::VectorXd y;
            tangent_.multiply(x, y);
            return Eigen::VectorXd(y + rigid_.rows() * (spring_ * (rigid_.rows().transpose() * x)));
        };
        system_.definite_tangent(X, preconditioner_);
        if (cholesky_.factor(preconditioner_)) {
            const GmresResult solved = gmres(
                A, [&](const Eigen::VectorXd& x) { return cholesky_.solve(x); }, -R, tolerance, most_iterations);
            // Far from the solution a rough direction is worth more than an exact one that costs ten times as much.
            if (solved.relative_residual <= (relative_residual > 1e-3 ? 0.3 : tolerance))
                return solved.x;
        }
        preconditioner_ = tangent_;
        preconditioner_.add_to_diagonal(0, spring_);
        preconditioner_.add_to_diagonal(1, spring_);
        preconditioner_.add_to_diagonal(preconditioner_.size() - 1, spring_);
        const Lu lu(preconditioner_);
        return gmres(
                   A, [&](const Eigen::VectorXd& x) { return lu.solve(x); }, -R, tolerance, most_iterations)
            .x;
    }

    /// Steps within which the residual must have halved.
    static constexpr int patience = 15;

    const Eigen::Matrix3Xi& triangle_;
    System& system_;
    RigidMotion rigid_;
    BlockMatrix& tangent_;
    BlockMatrix preconditioner_;
    Cholesky& cholesky_;
    const EquilibriumOptions& options_;
    const Progress& progress_;
    double reference_;
    double spring_ = 0;
};

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
    System system(part, element, law, h0, friction, node_frames(part, element, start));
    Newton newton(part, element, system, start, matrix, cholesky, options, progress);
    EquilibriumResult result = newton.solve(start, 1, options.tolerance);
    // From far away: pass from the gradient of the energy, whose zero is the start, to the virtual-work equations.
    constexpr double loose = 1e-3, smallest_stride = 1.0 / 16;
    const size_t most_steps = size_t(2 * options.most_steps / 3); // of all attempts together
    Eigen::Matrix2Xd X = start;
    double reached = 0;
    for (double stride = 0.5; result.ended != Ended::converged && stride >= smallest_stride;) {
        if (result.steps.size() > most_steps) {
            result.ended = Ended::too_many_steps;
            break;
        }
        const double share = std::min(1.0, reached + stride);
        EquilibriumResult next = newton.solve(X, share, share < 1 ? loose : options.tolerance);
        const bool solved = next.ended == Ended::converged;
        result.steps.insert(result.steps.end(), next.steps.begin(), next.steps.end());
        if (solved && share == 1) {
            next.steps = std::move(result.steps);
            return next;
        }
        if (solved) {
            X = next.position;
            reached = share;
        }
        stride *= solved ? 2 : 0.5;
    }
    return result;
}

} // namespace spia
