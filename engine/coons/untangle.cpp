#include "engine/coons/untangle.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/core/parallel.h"

namespace spia {

namespace {

using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;

constexpr double least_eps = 1e-9;      // of an ideal cell's area
constexpr double small_decrease = 1e-3; // of the energy in one step: shape is good enough
constexpr double first_eps = 0.01;      // at least
constexpr double enough_decrease = 0.1; // of the energy in one step: worth another one with the same eps
constexpr int most_steps_per_eps = 5;
constexpr double slower = 0.5; // chi of the worst corner falls to this part of itself when eps is lowered
constexpr double armijo = 1e-4;
constexpr int most_halvings = 40;

/// A corner of a cell: its node, the next and the previous node around the cell, and the wanted lengths to
/// them.
struct CellCorner {
    std::array<int, 3> node;
    double length_next, length_previous;
};

std::vector<CellCorner> cell_corners(const QuadGrid& grid)
{
    // Wanted: cells as oblong as the sides are long, of equal area.
    const auto row_length = [&](int j) {
        double sum = 0;
        for (int i = 0; i < grid.columns; ++i)
            sum += (grid.position.col(grid.node(i + 1, j)) - grid.position.col(grid.node(i, j))).norm();
        return sum;
    };
    const auto column_length = [&](int i) {
        double sum = 0;
        for (int j = 0; j < grid.rows; ++j)
            sum += (grid.position.col(grid.node(i, j + 1)) - grid.position.col(grid.node(i, j))).norm();
        return sum;
    };
    double du = (row_length(0) + row_length(grid.rows)) / (2 * grid.columns);
    double dv = (column_length(0) + column_length(grid.columns)) / (2 * grid.rows);
    double doubled_area = 0; // all cells together, whatever the inner nodes
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
            const Eigen::Vector3d p = grid.position.col(grid.node(i + 1, j + 1)) - grid.position.col(grid.node(i, j));
            const Eigen::Vector3d q = grid.position.col(grid.node(i, j + 1)) - grid.position.col(grid.node(i + 1, j));
            doubled_area += p.x() * q.y() - p.y() * q.x();
        }
    if (doubled_area > 0) {
        const double scale = std::sqrt(doubled_area / 2 / (grid.columns * grid.rows * du * dv));
        du *= scale;
        dv *= scale;
    }
    std::vector<CellCorner> corners;
    corners.reserve(size_t(4 * grid.columns * grid.rows));
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
            const std::array<int, 4> node = {grid.node(i, j), grid.node(i + 1, j), grid.node(i + 1, j + 1),
                                             grid.node(i, j + 1)};
            for (size_t k = 0; k < 4; ++k)
                corners.push_back(
                    {{node[k], node[(k + 1) % 4], node[(k + 3) % 4]}, k % 2 == 0 ? du : dv, k % 2 == 0 ? dv : du});
        }
    return corners;
}

/// The scaled edges of a corner, (next, previous), as four numbers.
Vector4d scaled_edges(const CellCorner& corner, const Eigen::Matrix3Xd& position)
{
    Vector4d edges;
    edges << (position.col(corner.node[1]) - position.col(corner.node[0])).head<2>() / corner.length_next,
        (position.col(corner.node[2]) - position.col(corner.node[0])).head<2>() / corner.length_previous;
    return edges;
}

double determinant(const Vector4d& J) { return J[0] * J[3] - J[1] * J[2]; }

/// chi(D) = (D + sqrt(D^2 + eps^2)) / 2, without cancellation for negative D.
double chi(double D, double eps)
{
    const double root = std::hypot(D, eps);
    return D > 0 ? (D + root) / 2 : eps * eps / (2 * (root - D));
}

/// phi = |J|^2 / chi(D) + area_weight (D^2 + 1) / chi(D)
double corner_energy(const Vector4d& J, double eps, double area_weight)
{
    const double D = determinant(J);
    return (J.squaredNorm() + area_weight * (D * D + 1)) / chi(D, eps);
}

/// Gradient, and second derivative without its negative eigenvalues.
void corner_derivatives(const Vector4d& J, double eps, double area_weight, Vector4d& gradient, Matrix4d& hessian)
{
    const double D = determinant(J), X = chi(D, eps), root = std::hypot(D, eps);
    const double X1 = X / root;                             // chi'
    const double X2 = eps * eps / (2 * root * root * root); // chi''
    const double top = J.squaredNorm() + area_weight * (D * D + 1);
    const double phi_a = 1 / X, phi_aD = -X1 / (X * X);
    const double phi_D = 2 * area_weight * D / X - top * X1 / (X * X);
    const double phi_DD =
        2 * area_weight / X - 4 * area_weight * D * X1 / (X * X) - top * X2 / (X * X) + 2 * top * X1 * X1 / (X * X * X);
    const Vector4d c(J[3], -J[2], -J[1], J[0]); // dD / dJ
    gradient = 2 * phi_a * J + phi_D * c;
    hessian = 2 * phi_a * Matrix4d::Identity() + 2 * phi_aD * (J * c.transpose() + c * J.transpose()) +
              phi_DD * c * c.transpose();
    hessian(0, 3) += phi_D;
    hessian(3, 0) += phi_D;
    hessian(1, 2) -= phi_D;
    hessian(2, 1) -= phi_D;
    const Eigen::SelfAdjointEigenSolver<Matrix4d> eigen(hessian);
    hessian = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() * eigen.eigenvectors().transpose();
}

class Untangler {
public:
    Untangler(QuadGrid& grid, const std::vector<Pull>& pulls, const UntangleOptions& options)
        : grid_(grid), pulls_(pulls), options_(options), corner_(cell_corners(grid)), unknown_(size_t(grid.nodes()), -1)
    {
        for (int j = 1; j < grid.rows; ++j)
            for (int i = 1; i < grid.columns; ++i)
                unknown_[size_t(grid.node(i, j))] = 2 * unknowns_++;
        gradient_.resize(corner_.size());
        hessian_.resize(corner_.size());
        value_.resize(corner_.size());
        if (!corner_.empty())
            cell_area_ = corner_[0].length_next * corner_[0].length_previous;
    }

    void run(const Progress& progress)
    {
        if (unknowns_ == 0)
            return;
        double smallest = smallest_determinant();
        eps_ = smallest > 0 ? least_eps : std::max(first_eps, -smallest);
        int at_this_eps = 0;
        for (int step = 0; step < options_.most_steps; ++step) {
            progress.checkpoint(double(step) / options_.most_steps, "untangling");
            if (smallest > 0)
                eps_ = std::min(least_eps, 0.01 * smallest);
            const double before = energy(grid_.position);
            const bool moved = newton_step(before);
            const double left = energy(grid_.position) / before;
            smallest = smallest_determinant();
            if (smallest > 0) {
                if (!moved || left > 1 - small_decrease)
                    return;
            } else if (++at_this_eps == most_steps_per_eps || left > 1 - enough_decrease) {
                // Not to zero at once: the energy has to follow, or its steep wall stands in the way of the worst
                // corner.
                if (eps_ <= least_eps)
                    return; // folded and standing still
                const double target = chi(smallest, eps_) * slower;
                eps_ = std::max(least_eps, smallest < target ? 2 * std::sqrt(target * (target - smallest)) : least_eps);
                at_this_eps = 0;
            }
        }
    }

private:
    double smallest_determinant() const
    {
        double smallest = std::numeric_limits<double>::infinity();
        for (const CellCorner& corner : corner_)
            smallest = std::min(smallest, determinant(scaled_edges(corner, grid_.position)));
        return smallest;
    }

    double energy(const Eigen::Matrix3Xd& position)
    {
        parallel_for(int(corner_.size()), [&](int k) {
            value_[size_t(k)] = corner_energy(scaled_edges(corner_[size_t(k)], position), eps_, options_.area_weight);
        });
        double sum = 0;
        for (const double value : value_)
            sum += value;
        for (const Pull& pull : pulls_)
            sum += pull.weight / 2 * (position.col(pull.node).head<2>() - pull.target).squaredNorm() / cell_area_;
        return sum;
    }

    /// @return false if no step lowers the energy
    bool newton_step(double before)
    {
        const Eigen::VectorXd step = newton_direction();
        double slope = step.dot(total_gradient_);
        if (!(slope < 0))
            return false;
        Eigen::Matrix3Xd trial = grid_.position;
        double length = 1;
        for (int halving = 0; halving < most_halvings; ++halving, length /= 2) {
            for (size_t v = 0; v < unknown_.size(); ++v)
                if (unknown_[v] >= 0)
                    trial.col(Eigen::Index(v)).head<2>() =
                        grid_.position.col(Eigen::Index(v)).head<2>() + length * step.segment<2>(unknown_[v]);
            if (energy(trial) <= before + armijo * length * slope) {
                grid_.position = trial;
                return true;
            }
        }
        return false;
    }

    Eigen::VectorXd newton_direction()
    {
        parallel_for(int(corner_.size()), [&](int k) {
            corner_derivatives(scaled_edges(corner_[size_t(k)], grid_.position), eps_, options_.area_weight,
                               gradient_[size_t(k)], hessian_[size_t(k)]);
        });
        total_gradient_ = Eigen::VectorXd::Zero(2 * unknowns_);
        std::vector<Eigen::Triplet<double>> entries;
        entries.reserve(20 * corner_.size());
        for (size_t k = 0; k < corner_.size(); ++k) {
            // d edges / d nodes: minus both at the corner's node, plus one each at the other two
            const double p = 1 / corner_[k].length_next, q = 1 / corner_[k].length_previous;
            Eigen::Matrix<double, 4, 6> B = Eigen::Matrix<double, 4, 6>::Zero();
            B << -p, 0, p, 0, 0, 0, 0, -p, 0, p, 0, 0, -q, 0, 0, 0, q, 0, 0, -q, 0, 0, 0, q;
            const Eigen::Matrix<double, 6, 1> g = B.transpose() * gradient_[k];
            const Eigen::Matrix<double, 6, 6> H = B.transpose() * hessian_[k] * B;
            for (int a = 0; a < 3; ++a) {
                const int row = unknown_[size_t(corner_[k].node[size_t(a)])];
                if (row < 0)
                    continue;
                total_gradient_.segment<2>(row) += g.segment<2>(2 * a);
                for (int b = 0; b < 3; ++b) {
                    const int column = unknown_[size_t(corner_[k].node[size_t(b)])];
                    if (column < 0)
                        continue;
                    for (int i = 0; i < 2; ++i)
                        for (int j = 0; j < 2; ++j)
                            if (row + i >= column + j)
                                entries.emplace_back(row + i, column + j, H(2 * a + i, 2 * b + j));
                }
            }
        }
        for (const Pull& pull : pulls_) {
            const int row = unknown_[size_t(pull.node)];
            const double stiffness = pull.weight / cell_area_;
            total_gradient_.segment<2>(row) += stiffness * (grid_.position.col(pull.node).head<2>() - pull.target);
            for (int i = 0; i < 2; ++i)
                entries.emplace_back(row + i, row + i, stiffness);
        }
        // Clamping may leave a direction without stiffness; a little of the identity bounds the step there.
        for (int i = 0; i < 2 * unknowns_; ++i)
            entries.emplace_back(i, i, 1e-6 / cell_area_);
        Eigen::SparseMatrix<double> matrix(2 * unknowns_, 2 * unknowns_);
        matrix.setFromTriplets(entries.begin(), entries.end());
        if (!analyzed_)
            factor_.analyzePattern(matrix);
        analyzed_ = true;
        factor_.factorize(matrix);
        return factor_.solve(-total_gradient_);
    }

    QuadGrid& grid_;
    const std::vector<Pull>& pulls_;
    const UntangleOptions& options_;
    std::vector<CellCorner> corner_;
    std::vector<int> unknown_; // per node, where its two coordinates start; -1 on the border
    int unknowns_ = 0;         // free nodes
    double cell_area_ = 1;
    double eps_ = 0;
    std::vector<Vector4d> gradient_;
    std::vector<Matrix4d> hessian_;
    std::vector<double> value_;
    Eigen::VectorXd total_gradient_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor_;
    bool analyzed_ = false;
};

} // namespace

void untangle(QuadGrid& planar, const std::vector<Pull>& pulls, const UntangleOptions& options,
              const Progress& progress)
{
    Untangler(planar, pulls, options).run(progress);
}

} // namespace spia
