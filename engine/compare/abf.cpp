#include "engine/compare/abf.h"

#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <fmt/core.h>
#include <numbers>

#include "engine/compare/lscm.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/mesh/topology.h"
#include "engine/sparse/block_matrix.h"
#include "engine/sparse/cholesky.h"

namespace spia {
namespace {

using std::numbers::pi;
using Rows = Eigen::Matrix<double, 6, 3>; ///< planarity and wheel of the three corners against the
                                          ///< three angles
using Vector6d = Eigen::Matrix<double, 6, 1>;

double corner_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::vector<char> inner_vertices(const TriMesh& part)
{
    std::vector<char> inner(size_t(part.vertices()), 1);
    for (const auto& loop : boundary_loops(part))
        for (int v : loop)
            inner[size_t(v)] = 0;
    return inner;
}

Eigen::Matrix3Xd wanted_angles(const TriMesh& part, const std::vector<char>& inner)
{
    Eigen::Matrix3Xd result(3, part.triangles());
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(part.vertices());
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d at = part.position.col(part.triangle(k, f));
            result(k, f) = corner_angle(part.position.col(part.triangle((k + 1) % 3, f)) - at,
                                        part.position.col(part.triangle((k + 2) % 3, f)) - at);
            sum[part.triangle(k, f)] += result(k, f);
        }
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            if (const int v = part.triangle(k, f); inner[size_t(v)])
                result(k, f) *= 2 * pi / sum[v];
    return result;
}

/// One Newton iteration after the other on angles and multipliers.
class Solver {
public:
    Solver(const TriMesh& part, AbfAngles& state, BlockMatrix& matrix, Cholesky& cholesky)
        : part_(part), state_(state), inner_(inner_vertices(part)), matrix_(matrix), cholesky_(cholesky),
          element_(size_t(part.triangles())), error_(2, part.vertices())
    {
        state.wanted = wanted_angles(part, inner_);
        constexpr double least = pi / 180; // a valid start; the wanted ones may be beyond
        state.angle = state.wanted.cwiseMax(least).cwiseMin(pi - least);
        state.triangle = Eigen::VectorXd::Zero(part.triangles());
        state.vertex = Eigen::Matrix2Xd::Zero(2, part.vertices());
    }

    /// Measures the optimality conditions at the present state.
    void measure()
    {
        error_.setZero();
        for (int f = 0; f < part_.triangles(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int next = (k + 1) % 3, previous = (k + 2) % 3;
                error_.col(part_.triangle(k, f)) +=
                    Eigen::Vector2d(state_.angle(k, f),
                                    std::log(std::sin(state_.angle(next, f)) / std::sin(state_.angle(previous, f))));
            }
        for (int v = 0; v < part_.vertices(); ++v)
            error_.col(v) =
                inner_[size_t(v)] ? Eigen::Vector2d(error_(0, v) - 2 * pi, error_(1, v)) : Eigen::Vector2d(0, 0);
        state_.constraint_error = error_.size() ? error_.cwiseAbs().maxCoeff() : 0;
        state_.gradient_error = 0;
        for (int f = 0; f < part_.triangles(); ++f) {
            const Eigen::Vector3d gradient = objective_gradient(f) + rows(f).transpose() * multipliers(f) +
                                             Eigen::Vector3d::Constant(state_.triangle[f]);
            const Eigen::Vector3d shift = 0.5 * gradient.cwiseProduct(state_.wanted.col(f).cwiseAbs2());
            state_.gradient_error = std::max(state_.gradient_error, shift.cwiseAbs().maxCoeff());
            state_.constraint_error = std::max(state_.constraint_error, std::abs(triangle_error(f)));
        }
    }

    /// @returns the share of the full step that was taken
    double step()
    {
        const int faces = part_.triangles();
        std::vector<Vector6d> right(static_cast<size_t>(faces));
        parallel_for(faces, [&](int f) {
            const Rows B = rows(f);
            const Eigen::Vector3d inverse = hessian(f).cwiseInverse();
            const double total = inverse.sum();
            const Eigen::Matrix3d free = Eigen::Matrix3d(inverse.asDiagonal()) - inverse * inverse.transpose() / total;
            element_[size_t(f)] = B * free * B.transpose();
            right[size_t(f)] = -B * (free * objective_gradient(f) + inverse * (triangle_error(f) / total));
        });
        matrix_.assemble(element_);
        Eigen::Matrix2Xd b = error_;
        for (int f = 0; f < faces; ++f)
            for (int k = 0; k < 3; ++k)
                b.col(part_.triangle(k, f)) += right[size_t(f)].segment<2>(2 * k);
        for (int v = 0; v < part_.vertices(); ++v)
            if (!inner_[size_t(v)])
                matrix_.add_to_diagonal(v, Eigen::Matrix2d::Identity());
        if (!cholesky_.factor(matrix_))
            throw SolveError("the reduced system of ABF++ is not positive definite; the angles have degenerated");
        const Eigen::VectorXd solution = cholesky_.solve(b.reshaped());
        const Eigen::Map<const Eigen::Matrix2Xd> vertex(solution.data(), 2, part_.vertices());

        Eigen::Matrix3Xd change(3, faces);
        Eigen::VectorXd triangle(faces);
        double share = 1;
        constexpr double of_the_way = 0.9; // to where an angle would become 0 or pi
        for (int f = 0; f < faces; ++f) {
            Vector6d lambda;
            for (int k = 0; k < 3; ++k)
                lambda.segment<2>(2 * k) = vertex.col(part_.triangle(k, f));
            const Eigen::Vector3d inverse = hessian(f).cwiseInverse();
            const Eigen::Vector3d force = objective_gradient(f) + rows(f).transpose() * lambda;
            triangle[f] = (triangle_error(f) - inverse.dot(force)) / inverse.sum();
            change.col(f) = -inverse.cwiseProduct(force + Eigen::Vector3d::Constant(triangle[f]));
            for (int k = 0; k < 3; ++k) {
                const double room = change(k, f) < 0 ? state_.angle(k, f) : pi - state_.angle(k, f);
                share = std::min(share, of_the_way * room / std::max(std::abs(change(k, f)), 1e-300));
            }
        }
        state_.angle += share * change;
        state_.triangle += share * (triangle - state_.triangle);
        state_.vertex += share * (vertex - state_.vertex);
        return share;
    }

private:
    Eigen::Vector3d objective_gradient(int f) const
    {
        const auto wanted = state_.wanted.col(f).array();
        return 2 * (state_.angle.col(f).array() - wanted) / wanted.square();
    }

    double triangle_error(int f) const { return state_.angle.col(f).sum() - pi; }

    Vector6d multipliers(int f) const
    {
        Vector6d result;
        for (int k = 0; k < 3; ++k)
            result.segment<2>(2 * k) = state_.vertex.col(part_.triangle(k, f));
        return result;
    }

    /// Derivatives of the constraints of the three corners' vertices; no rows for the boundary.
    Rows rows(int f) const
    {
        Rows result = Rows::Zero();
        for (int k = 0; k < 3; ++k)
            if (inner_[size_t(part_.triangle(k, f))]) {
                const int next = (k + 1) % 3, previous = (k + 2) % 3;
                result(2 * k, k) = 1;
                result(2 * k + 1, next) = 1 / std::tan(state_.angle(next, f));
                result(2 * k + 1, previous) = -1 / std::tan(state_.angle(previous, f));
            }
        return result;
    }

    /// Second derivatives of the Lagrangian, kept positive where an extreme multiplier would turn
    /// them over: the step is then no longer Newton's, but its fixed points are the same.
    Eigen::Vector3d hessian(int f) const
    {
        Eigen::Vector3d result;
        for (int k = 0; k < 3; ++k) {
            const int next = part_.triangle((k + 1) % 3, f), previous = part_.triangle((k + 2) % 3, f);
            const double sine = std::sin(state_.angle(k, f)), weight = 2 / std::pow(state_.wanted(k, f), 2);
            // This corner is `next` for the previous vertex, and `previous` for the next one.
            const double wheel = (state_.vertex(1, next) - state_.vertex(1, previous)) / (sine * sine);
            result[k] = std::max(weight + wheel, 0.1 * weight);
        }
        return result;
    }

    const TriMesh& part_;
    AbfAngles& state_;
    std::vector<char> inner_;
    BlockMatrix& matrix_;
    Cholesky& cholesky_;
    std::vector<Matrix6d> element_;
    Eigen::Matrix2Xd error_;
};

/// Triangles with the given angles and the part's areas.
FlatShapes shapes_of(const TriMesh& part, const Eigen::Matrix3Xd& angle)
{
    const Eigen::VectorXd area = area_vectors(part).colwise().norm();
    FlatShapes shapes(size_t(part.triangles()));
    for (int f = 0; f < part.triangles(); ++f) {
        // sides are as the sines of the opposite angles
        const Eigen::Vector3d sine = angle.col(f).array().sin();
        const double scale = std::sqrt(2 * area[f] / (sine[0] * sine[1] * sine[2]));
        shapes[size_t(f)] = {scale * sine[2], std::polar(scale * sine[1], angle(0, f))};
    }
    return shapes;
}

/// Root mean square of the difference between the angles of a layout and those it was made from,
/// radians.
double misfit(const TriMesh& part, const Eigen::Matrix2Xd& flat, const Eigen::Matrix3Xd& angle)
{
    double sum = 0;
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector2d at = flat.col(part.triangle(k, f));
            const Eigen::Vector2d p = flat.col(part.triangle((k + 1) % 3, f)) - at;
            const Eigen::Vector2d q = flat.col(part.triangle((k + 2) % 3, f)) - at;
            sum += std::pow(std::atan2(p[0] * q[1] - p[1] * q[0], p.dot(q)) - angle(k, f), 2);
        }
    return std::sqrt(sum / (3.0 * part.triangles()));
}

AbfAngles solve(const TriMesh& part, const AbfOptions& options, BlockMatrix& matrix, Cholesky& cholesky,
                const Progress& progress)
{
    AbfAngles result;
    Solver solver(part, result, matrix, cholesky);
    solver.measure();
    const auto error = [&] { return std::max(result.constraint_error, result.gradient_error); };
    const double first = std::max(error(), 1e-3);
    for (; result.iterations < options.most_steps && error() > options.tolerance; ++result.iterations) {
        const double gained = std::log(first / error()) / std::log(first / options.tolerance);
        progress.checkpoint(gained, fmt::format("ABF++ step {}, error {:.1e}", result.iterations + 1, error()));
        solver.step();
        solver.measure();
    }
    result.converged = error() <= options.tolerance;
    return result;
}

} // namespace

AbfAngles abf_angles(const TriMesh& part, const AbfOptions& options, const Progress& progress)
{
    require_sheet(part);
    progress.checkpoint(0, "ordering the equations of ABF++");
    BlockMatrix matrix(part.triangle, part.vertices());
    Cholesky cholesky(matrix);
    return solve(part, options, matrix, cholesky, progress);
}

FlatMap abf(const TriMesh& part, const AbfOptions& options, const Progress& progress)
{
    require_sheet(part);
    progress.checkpoint(0, "ordering the equations of ABF++");
    BlockMatrix matrix(part.triangle, part.vertices());
    Cholesky cholesky(matrix);
    const AbfAngles angles = solve(part, options, matrix, cholesky, progress.part(0.1, 0.8));
    FlatMap map;
    map.position =
        conformal_layout(part, shapes_of(part, angles.angle), far_pins(part), matrix, cholesky, progress.part(0.8, 1));
    scale_to_area_of(part, map.position);
    map.iterations = angles.iterations;
    map.ended =
        fmt::format("{}: constraints to {:.1e}, gradient to {:.1e}; the layout has the angles to {:.1e} rad rms",
                    angles.converged ? "converged" : "most steps taken", angles.constraint_error, angles.gradient_error,
                    misfit(part, map.position, angles.angle));
    return map;
}

} // namespace spia
