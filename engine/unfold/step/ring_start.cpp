#include "engine/unfold/step/ring_start.h"

#include <algorithm>
#include <cmath>

#include "engine/core/angle.h"
#include "engine/core/small_sparse.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Which vertices lie on edges that go around and are not held.
std::vector<char> far_edges(const FreedPiece& piece, const Eigen::VectorXd& angle)
{
    std::vector<char> held(size_t(piece.mesh.vertices()), 0), out = held;
    for (const int v : piece.held)
        held[size_t(v)] = 1;
    for (const std::vector<int>& loop : boundary_loops(piece.mesh)) {
        double around = 0;
        bool free = true;
        for (size_t k = 0; k < loop.size(); ++k) {
            around += std::remainder(angle[loop[(k + 1) % loop.size()]] - angle[loop[k]], full_turn);
            free &= !held[size_t(loop[k])];
        }
        if (free && std::abs(around) > full_turn / 2)
            for (const int v : loop)
                out[size_t(v)] = 1;
    }
    return out;
}

/// One coordinate that is harmonic where it is not given. @param jump per edge what it grows by
/// from the lower vertex to the higher one beyond the difference of the two
Eigen::VectorXd harmonic(const std::vector<std::array<int, 2>>& edges, const Eigen::VectorXd& weight,
                         const Eigen::VectorXd& jump, const std::vector<char>& given, Eigen::VectorXd value)
{
    std::vector<int> row(given.size(), -1);
    int rows = 0;
    for (size_t v = 0; v < given.size(); ++v)
        row[v] = given[v] ? -1 : rows++;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(rows);
    for (size_t e = 0; e < edges.size(); ++e)
        for (const int side : {0, 1}) {
            const int v = edges[e][size_t(side)], other = edges[e][size_t(1 - side)];
            if (row[size_t(v)] < 0)
                continue;
            const double w = weight[Eigen::Index(e)], beyond = (side == 0 ? 1 : -1) * jump[Eigen::Index(e)];
            entries.emplace_back(row[size_t(v)], row[size_t(v)], w);
            right[row[size_t(v)]] += w * beyond;
            if (row[size_t(other)] >= 0)
                entries.emplace_back(row[size_t(v)], row[size_t(other)], -w);
            else
                right[row[size_t(v)]] += w * value[other];
        }
    Eigen::SparseMatrix<double> matrix(rows, rows);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd solved = SparseLdlt(matrix).solve(right);
    for (size_t v = 0; v < given.size(); ++v)
        if (row[v] >= 0)
            value[Eigen::Index(v)] = solved[row[v]];
    return value;
}

} // namespace

Eigen::Matrix2Xd ring_start(const FreedPiece& piece, const Eigen::Matrix3Xd& state, const RingChart& chart)
{
    const Eigen::Index count = state.cols();
    Eigen::VectorXd angle(count), grown = Eigen::VectorXd::Zero(count);
    for (Eigen::Index v = 0; v < count; ++v) {
        const Eigen::Vector2d at = chart.place(state.col(v));
        angle[v] = std::atan2(at[1], at[0]);
    }
    std::vector<std::array<int, 2>> edges;
    const std::vector<EdgeUse> uses = edge_uses(piece.mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t) { edges.push_back({uses[begin].low, uses[begin].high}); });
    Eigen::VectorXd weight(Eigen::Index(edges.size())), jump(weight.size());
    for (size_t e = 0; e < edges.size(); ++e) {
        const auto [a, b] = edges[e];
        weight[Eigen::Index(e)] = 1 / (piece.mesh.position.col(a) - piece.mesh.position.col(b)).norm();
        jump[Eigen::Index(e)] = std::remainder(angle[b] - angle[a], full_turn) - (angle[b] - angle[a]);
    }
    std::vector<char> held(size_t(count), 0);
    for (const int v : piece.held) {
        held[size_t(v)] = 1;
        grown[v] = std::log(chart.place(state.col(v)).norm());
    }
    angle = harmonic(edges, weight, jump, held, angle);
    const std::vector<char> far = far_edges(piece, angle);
    const double reach = std::log(chart.radius_of(area(piece.mesh)));
    for (Eigen::Index v = 0; v < count; ++v)
        if (far[size_t(v)]) {
            held[size_t(v)] = 1;
            grown[v] = reach;
        }
    grown = harmonic(edges, weight, Eigen::VectorXd::Zero(weight.size()), held, grown);
    Eigen::Matrix2Xd X(2, count);
    for (Eigen::Index v = 0; v < count; ++v)
        X.col(v) = std::exp(grown[v]) * Eigen::Vector2d(std::cos(angle[v]), std::sin(angle[v]));
    return X;
}

} // namespace spia
