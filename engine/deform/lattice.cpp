#include "engine/deform/lattice.h"

#include <Eigen/LU>
#include <algorithm>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/nurbs/basis.h"

namespace spia {
namespace {

constexpr int most_points = 64; // along an edge
constexpr int most_degree = 5;

std::vector<double> even_knots(int count, int degree)
{
    std::vector<double> knots(size_t(count + degree + 1), 0);
    const int spans = count - degree;
    for (int i = 0; i < count + degree + 1; ++i)
        knots[size_t(i)] = std::clamp(double(i - degree) / spans, 0., 1.);
    return knots;
}

void require_counts(const std::array<int, 3>& count, const std::array<int, 3>& degree)
{
    for (size_t k = 0; k < 3; ++k) {
        if (count[k] < 2 || count[k] > most_points)
            throw InputError(
                fmt::format("a lattice has from 2 to {} points along each edge, not {}", most_points, count[k]));
        if (degree[k] < 1 || degree[k] > std::min(count[k] - 1, most_degree))
            throw InputError(
                fmt::format("a lattice with {} points along an edge has a degree from 1 to {} there, not {}", count[k],
                            std::min(count[k] - 1, most_degree), degree[k]));
    }
}

} // namespace

Lattice lattice_around(const MultiPatch& surface, std::array<int, 3> count, std::array<int, 3> degree)
{
    for (size_t k = 0; k < 3; ++k)
        degree[k] = std::min(degree[k], std::max(count[k] - 1, 1));
    require_counts(count, degree);
    Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL), high = -low;
    for (const NurbsSurface& patch : surface.patch) {
        low = low.cwiseMin(patch.control.rowwise().minCoeff());
        high = high.cwiseMax(patch.control.rowwise().maxCoeff());
    }
    const double size = (high - low).norm();
    if (!(size > 0 && std::isfinite(size)))
        throw InputError("there is no surface to lay a lattice around");
    constexpr double margin = 0.02, least = 0.1; // of the size
    Eigen::Vector3d edge = (high - low).array() + 2 * margin * size;
    edge = edge.cwiseMax(least * size);
    Lattice lattice;
    lattice.origin = (low + high - edge) / 2;
    lattice.edge = edge.asDiagonal();
    lattice.count = count;
    lattice.degree = degree;
    lattice.move = Eigen::Matrix3Xd::Zero(3, lattice.points());
    return lattice;
}

void require_sound(const Lattice& lattice)
{
    require_counts(lattice.count, lattice.degree);
    if (lattice.move.cols() != lattice.points())
        throw InputError(fmt::format("a lattice of {} x {} x {} points needs {} displacements, not {}",
                                     lattice.count[0], lattice.count[1], lattice.count[2], lattice.points(),
                                     lattice.move.cols()));
    if (!lattice.origin.allFinite() || !lattice.edge.allFinite() || !lattice.move.allFinite())
        throw InputError("a lattice has a place that is not a finite number");
    const double product = lattice.edge.col(0).norm() * lattice.edge.col(1).norm() * lattice.edge.col(2).norm();
    if (!(std::abs(lattice.edge.determinant()) > 1e-9 * product))
        throw InputError("the box of a lattice has no volume: its three edges lie in one plane");
}

Eigen::Matrix3Xd rest_positions(const Lattice& lattice)
{
    std::array<std::vector<double>, 3> at;
    for (size_t a = 0; a < 3; ++a) {
        const std::vector<double> knots = even_knots(lattice.count[a], lattice.degree[a]);
        for (int i = 0; i < lattice.count[a]; ++i) {
            double sum = 0;
            for (int k = 1; k <= lattice.degree[a]; ++k)
                sum += knots[size_t(i + k)];
            at[a].push_back(sum / lattice.degree[a]);
        }
    }
    Eigen::Matrix3Xd position(3, lattice.points());
    for (int k = 0; k < lattice.count[2]; ++k)
        for (int j = 0; j < lattice.count[1]; ++j)
            for (int i = 0; i < lattice.count[0]; ++i)
                position.col(lattice.index(i, j, k)) =
                    lattice.origin +
                    lattice.edge * Eigen::Vector3d(at[0][size_t(i)], at[1][size_t(j)], at[2][size_t(k)]);
    return position;
}

LatticeMap::LatticeMap(const Lattice& lattice) : lattice_(lattice)
{
    require_sound(lattice);
    to_box_ = lattice.edge.inverse();
    for (size_t a = 0; a < 3; ++a)
        knots_[a] = even_knots(lattice.count[a], lattice.degree[a]);
}

Eigen::Vector3d LatticeMap::displacement(const Eigen::Vector3d& place) const
{
    const Eigen::Vector3d t = (to_box_ * (place - lattice_.origin)).cwiseMax(0).cwiseMin(1);
    std::array<BasisValues, 3> b;
    for (size_t a = 0; a < 3; ++a)
        b[a] = basis(knots_[a], lattice_.degree[a], t[Eigen::Index(a)]);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = 0; k <= lattice_.degree[2]; ++k)
        for (int j = 0; j <= lattice_.degree[1]; ++j) {
            const double jk = b[1].value[size_t(j)] * b[2].value[size_t(k)];
            for (int i = 0; i <= lattice_.degree[0]; ++i)
                sum += b[0].value[size_t(i)] * jk *
                       lattice_.move.col(lattice_.index(b[0].first + i, b[1].first + j, b[2].first + k));
        }
    return sum;
}

} // namespace spia
