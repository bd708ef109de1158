#include "engine/forming/solver/initial_guess.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/small_sparse.h"
#include "engine/forming/solver/flips.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

constexpr double steepest_projected = 65 * std::numbers::pi / 180;
constexpr int few_iterations = 2, most_iterations = 12;

/// Looks along the stamping direction.
Eigen::Matrix2Xd projection(const TriMesh& part, const Eigen::Vector3d& direction)
{
    const Eigen::Vector3d x = direction.unitOrthogonal(), y = direction.cross(x);
    Eigen::Matrix2Xd result(2, part.vertices());
    result << x.transpose() * part.position, y.transpose() * part.position;
    return result;
}

/// The smallest eigenvector of the conformal energy sum A (|G|^2 / 2 - det G) against the mass of
/// the boundary, found by inverse iteration on one factor. None: triangles have flipped, or are too
/// thin.
std::optional<Eigen::Matrix2Xd> conformal(const TriMesh& part, const std::vector<Element>& element,
                                          const Eigen::Matrix2Xd& first, BlockMatrix& matrix, Cholesky& cholesky,
                                          const Progress& progress)
{
    std::vector<Matrix6d> local(element.size());
    for (size_t f = 0; f < element.size(); ++f) {
        const auto& g = element[f].gradient;
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) {
                const double dot = g.col(a).dot(g.col(b));
                const double cross = g(0, a) * g(1, b) - g(1, a) * g(0, b);
                local[f].block<2, 2>(2 * a, 2 * b) << dot, -cross, cross, dot;
            }
        local[f] *= element[f].area;
    }
    matrix.assemble(local);
    const double shift = 1e-8 * matrix.diagonal().mean();
    for (int i = 0; i < matrix.size(); ++i)
        matrix.add_to_diagonal(i, shift);
    const auto checkpoint = [&] { progress.checkpoint(0.1, "first guess: conformal map"); };
    checkpoint();
    if (!cholesky.factor(matrix))
        return std::nullopt;
    checkpoint();

    Eigen::VectorXd mass = Eigen::VectorXd::Zero(part.vertices());
    for (const auto& loop : boundary_loops(part))
        for (size_t i = 0; i < loop.size(); ++i) {
            const int a = loop[i], b = loop[(i + 1) % loop.size()];
            const double half = 0.5 * (part.position.col(a) - part.position.col(b)).norm();
            mass[a] += half;
            mass[b] += half;
        }
    // The map is conformal inside after the first iteration; the others turn its border to the
    // eigenvector, slowly where several are near each other. A start needs no more than a few, and
    // the last of them that is one-to-one.
    std::optional<Eigen::Matrix2Xd> best;
    Eigen::Matrix2Xd X = first;
    for (int iteration = 0; iteration < (best ? few_iterations : most_iterations); ++iteration) {
        checkpoint();
        X.colwise() -= (X * mass / mass.sum()).eval(); // translations cost no energy: keep them out
        X /= std::sqrt((X * mass.asDiagonal()).cwiseProduct(X).sum());
        const Eigen::VectorXd next = cholesky.solve((X * mass.asDiagonal()).reshaped());
        X = next.reshaped(2, X.cols());
        if (one_to_one_around_vertices(part, X))
            best = X;
    }
    return best;
}

/// Mean value weights are positive [Floater 2003], so with a convex border and the holes closed no
/// triangle flips.
Eigen::Matrix2Xd harmonic(const TriMesh& part)
{
    const auto loops = boundary_loops(part);
    // one more vertex in each hole
    const int n = part.vertices(), holes = int(loops.size()) - 1, all = n + holes;
    Eigen::Matrix2Xd X = Eigen::Matrix2Xd::Zero(2, all);
    std::vector<char> fixed(size_t(all), 0);
    double length = 0, along = 0;
    const auto edge = [&](const std::vector<int>& loop, size_t i) {
        return (part.position.col(loop[(i + 1) % loop.size()]) - part.position.col(loop[i])).norm();
    };
    for (size_t i = 0; i < loops[0].size(); ++i)
        length += edge(loops[0], i);
    const double radius = length / (2 * std::numbers::pi);
    for (size_t i = 0; i < loops[0].size(); ++i) {
        const double angle = 2 * std::numbers::pi * along / length;
        X.col(loops[0][i]) << radius * std::cos(angle), radius * std::sin(angle);
        fixed[size_t(loops[0][i])] = 1;
        along += edge(loops[0], i);
    }

    std::vector<Eigen::Triplet<double>> weight;
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = part.triangle(k, f), b = part.triangle((k + 1) % 3, f), c = part.triangle((k + 2) % 3, f);
            const Eigen::Vector3d ab = part.position.col(b) - part.position.col(a);
            const Eigen::Vector3d ac = part.position.col(c) - part.position.col(a);
            const double half =
                // tan(alpha/2) of the mean value weight
                0.5 * std::atan2(ab.cross(ac).norm(), ab.dot(ac));
            weight.emplace_back(a, b, std::tan(half) / ab.norm());
            weight.emplace_back(a, c, std::tan(half) / ac.norm());
        }
    for (int h = 1; h <= holes; ++h)
        for (int v : loops[size_t(h)]) { // a fan to the middle of the hole, combinatorial: any
                                         // positive weight will do
            const double w = 2.0 / length * double(loops[0].size());
            weight.emplace_back(v, n + h - 1, w);
            weight.emplace_back(n + h - 1, v, w);
        }
    std::vector<int> index(size_t(all), -1);
    int unknowns = 0;
    for (int v = 0; v < all; ++v)
        if (!fixed[size_t(v)])
            index[size_t(v)] = unknowns++;
    Eigen::VectorXd total = Eigen::VectorXd::Zero(all);
    for (const auto& w : weight)
        total[w.row()] += w.value();
    std::vector<Eigen::Triplet<double>> entry;
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(unknowns, 2);
    for (const auto& w : weight) {
        const int i = index[size_t(w.row())], j = index[size_t(w.col())];
        if (i < 0)
            continue;
        const double share = w.value() / total[w.row()];
        if (j >= 0)
            entry.emplace_back(i, j, -share);
        else
            right.row(i) += share * X.col(w.col()).transpose();
    }
    for (int i = 0; i < unknowns; ++i)
        entry.emplace_back(i, i, 1.0);
    Eigen::SparseMatrix<double> A(unknowns, unknowns);
    A.setFromTriplets(entry.begin(), entry.end());
    const SparseLu solver(A);
    if (!solver.ok())
        throw SolveError("the harmonic start could not be factored");
    const Eigen::MatrixX2d x = solver.solve(right);
    for (int v = 0; v < all; ++v)
        if (index[size_t(v)] >= 0)
            X.col(v) = x.row(index[size_t(v)]).transpose();
    return X.leftCols(n);
}

/// Uniform scale after which the area-weighted mean of ln(det G) is zero: as much thinning as
/// thickening.
void scale_to_part(const TriMesh& part, const std::vector<Element>& element, Eigen::Matrix2Xd& X)
{
    double sum = 0, area = 0;
    for (int f = 0; f < part.triangles(); ++f) {
        const Element& e = element[size_t(f)];
        sum += e.area * std::log(inverse_gradient(e, corners(X, part.triangle.col(f))).determinant());
        area += e.area;
    }
    X *= std::exp(-0.5 * sum / area);
}

} // namespace

InitialGuess initial_guess(const TriMesh& part, const std::vector<Element>& element, const StampingDirection& stamping,
                           BlockMatrix& matrix, Cholesky& cholesky, const Progress& progress)
{
    progress.checkpoint(0, "first guess: looking along the stamping direction");
    const Eigen::Matrix2Xd seen = projection(part, stamping.direction);
    if (stamping.height_field && stamping.steepest_angle < steepest_projected &&
        flipped_triangles(part.triangle, seen) == 0)
        return {seen, StartMethod::projection};
    progress.checkpoint(0.1, "first guess: conformal map");
    if (auto X = conformal(part, element, seen, matrix, cholesky, progress)) {
        scale_to_part(part, element, *X);
        return {std::move(*X), StartMethod::conformal};
    }
    progress.checkpoint(0.5, "first guess: harmonic map");
    Eigen::Matrix2Xd X = harmonic(part);
    const int flipped = flipped_triangles(part.triangle, X);
    if (!X.allFinite() || flipped > 0)
        throw SolveError("no start without flipped triangles was found: " + std::to_string(flipped) +
                         " triangles are too thin for the arithmetic; remesh the part");
    scale_to_part(part, element, X);
    return {std::move(X), StartMethod::harmonic};
}

} // namespace spia
