#include "engine/unfold/step/hinge_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"
#include "engine/mesh/vectors.h"
#include "engine/options/advice.h"

namespace spia {
namespace {

/// Per vertex: the greatest angle between neighbours of its faces, theirs across the edge opposite
/// to it among them. Where they turn as far as no facet of a bend does there is a sharp edge, which
/// is no chord.
Eigen::VectorXd facet_turns(const TriMesh& state, const std::vector<int>& faces)
{
    constexpr double most_facet = 0.8; // twice what fit_target() lets a chord turn from its arc
    const Eigen::Matrix3Xi triangle = state.triangle(Eigen::all, faces);
    const Eigen::Matrix3Xd normal = area_vectors({state.position, triangle});
    Eigen::VectorXd turn = Eigen::VectorXd::Zero(state.vertices());
    const std::vector<EdgeUse> uses = edge_uses(triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        for (size_t k = begin + 1; k < end; ++k) {
            const double angle = angle_between(normal.col(uses[begin].face), normal.col(uses[k].face));
            if (angle > most_facet)
                continue;
            for (const int f : {uses[begin].face, uses[k].face})
                for (const int v : triangle.col(f))
                    turn[v] = std::max(turn[v], angle);
        }
    });
    return turn;
}

/// Vertices of the part, the lower one first; ascending.
std::vector<std::array<int, 2>> hinge_edges(const std::vector<FreedPiece>& pieces)
{
    std::vector<std::array<int, 2>> edges;
    for (const FreedPiece& piece : pieces)
        for (const auto& [a, b] : piece.hinge) {
            const auto [lower, upper] = std::minmax(piece.vertex[size_t(a)], piece.vertex[size_t(b)]);
            edges.push_back({lower, upper});
        }
    std::sort(edges.begin(), edges.end());
    return edges;
}

} // namespace

TargetFit hinge_quality(const TargetSurface& face, const TriMesh& state, const std::vector<int>& fixed,
                        const std::vector<FreedPiece>& pieces)
{
    constexpr double too_far = 1e-3; // of the part
    TargetFit fit{face, 0, 0};
    std::vector<char> held(size_t(state.vertices()), 0);
    for (const FreedPiece& piece : pieces)
        for (const int v : piece.held)
            held[size_t(piece.vertex[size_t(v)])] = 1;
    const auto hinge = hinge_edges(pieces);
    const double limit = too_far * bounding_diagonal(state);
    const Eigen::VectorXd turn = facet_turns(state, fixed);
    for (const int f : fixed) {
        const auto t = state.triangle.col(f);
        for (const int v : t)
            if (held[size_t(v)]) {
                const Eigen::Vector3d x = state.position.col(v);
                const double off = (x - placed(face, developed(face, x))).norm();
                if (!(off <= limit))
                    throw InputError(fmt::format(
                        "the fixed face {} ends {:.3g} mm off the target, where freed faces are joined to it; {}", f,
                        off, mention(advice::common_edge)));
                fit.distance_mm = std::max(fit.distance_mm, off);
            }
        double chord = 0; // not every vertex on the hinge of a fillet has one of its faces' long
                          // edges
        for (const int v : t)
            if (held[size_t(v)])
                chord = std::max(chord, turn[v] / 2);
        const Eigen::Matrix3d c = state.position(Eigen::all, t);
        const Eigen::Vector3d normal = (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0));
        for (int k = 0; k < 3; ++k) {
            const int a = t[k], b = t[(k + 1) % 3];
            if (!std::binary_search(hinge.begin(), hinge.end(), std::array{std::min(a, b), std::max(a, b)}))
                continue;
            for (const int v : {a, b})
                fit.angle =
                    std::max(fit.angle, angle_between(outer_normal(face, state.position.col(v)), normal) - chord);
        }
    }
    return fit;
}

} // namespace spia
