#include "engine/coons/place_border.h"

#include <algorithm>
#include <array>

#include "engine/coons/boundary.h"

namespace spia {

namespace {

/// Per vertex of the outline the face whose edge leads from it to the next one.
std::vector<int> faces_along(const FilledMesh& filled)
{
    std::vector<int> next(size_t(filled.mesh.vertices()), -1), face(next.size(), -1);
    for (size_t i = 0; i < filled.outline.size(); ++i)
        next[size_t(filled.outline[i])] = filled.outline[(i + 1) % filled.outline.size()];
    const Eigen::Matrix3Xi& triangle = filled.mesh.triangle;
    for (int f = 0; f < triangle.cols(); ++f)
        for (int k = 0; k < 3; ++k)
            if (next[size_t(triangle(k, f))] == triangle((k + 1) % 3, f))
                face[size_t(triangle(k, f))] = f;
    return face;
}

Eigen::Vector2d position(const SidePoint& point, const Eigen::Matrix2Xd& plane)
{
    return (1 - point.weight) * plane.col(point.a) + point.weight * plane.col(point.b);
}

constexpr int places = 31; // that a node may take; the middle one divides the side evenly
constexpr int middle = places / 2;
constexpr double least_spacing = 0.2; // cells, along the outline
constexpr double impossible = 1e9;
constexpr double largest_bend = 1e4; // tan^2 of nearly a half turn

/// One node of the closed row of border nodes: its possible places. A corner has but the middle
/// one.
struct SlidingNode {
    int side, index; ///< of the node on the side
    bool corner;
    std::array<Eigen::Vector2d, places> place;

    double parameter(int at, int cells, double reach) const
    {
        return (index + double(at - middle) / middle * reach) / cells;
    }
};

/// The cost of leaving a node by the direction `out` when it was reached by `in`, both of unit
/// length.
double bend(const Eigen::Vector2d& in, const Eigen::Vector2d& out, bool corner)
{
    const double cosine = in.dot(out), sine = in.x() * out.y() - in.y() * out.x();
    if (corner) { // the cell there needs an angle below 180 degrees, better not by a hair
        constexpr double sharp_enough = 0.1;
        return cosine < 0 || sine > sharp_enough ? (sine > 0 ? 0 : largest_bend) : largest_bend * (sharp_enough - sine);
    }
    return cosine <= -1 + 2 / largest_bend ? largest_bend : (1 - cosine) / (1 + cosine);
}

} // namespace

BorderParameters even_border(int columns, int rows)
{
    BorderParameters even;
    for (int k = 0; k < 4; ++k) {
        const int cells = k % 2 == 0 ? columns : rows;
        even[size_t(k)] = Eigen::VectorXd::LinSpaced(cells + 1, 0, cells) / cells;
    }
    return even;
}

BorderParameters slid_border(const FilledMesh& filled, const BlankBoundary& boundary, int columns, int rows,
                             double reach)
{
    BorderParameters result = even_border(columns, rows);
    std::vector<SlidingNode> nodes;
    for (int k = 0; k < 4; ++k) {
        const std::vector<int>& side = boundary.side[size_t(k)];
        const Eigen::VectorXd chord = chord_parameters(side, filled.plane);
        const int cells = k % 2 == 0 ? columns : rows;
        for (int i = 0; i < cells; ++i) {
            SlidingNode node{k, i, i == 0, {}};
            for (int at = 0; at < places; ++at) {
                const double t = i == 0 ? 0 : std::clamp(node.parameter(at, cells, reach), 0.0, 1.0);
                node.place[size_t(at)] = position(point_on_side(side, chord, t), filled.plane);
            }
            nodes.push_back(node);
        }
    }
    const int n = int(nodes.size());
    nodes.push_back(nodes[0]); // around the loop and back to the first corner

    // State: the places of two neighbours. Each best path remembers its second node, so that the
    // loop can be closed.
    struct Best {
        double cost = impossible;
        int from = -1, second = -1;
    };
    // [place of node k][place of node k + 1]
    using Table = std::array<std::array<Best, places>, places>;
    std::vector<Table> best(static_cast<size_t>(n));
    const auto usable = [&](int k, int at) {
        const SlidingNode& node = nodes[size_t(k)];
        const double t = node.parameter(at, node.side % 2 == 0 ? columns : rows, reach);
        return node.corner ? at == middle : t > 0 && t < 1;
    };
    for (int k = 0; k < n; ++k)
        for (int a = 0; a < places; ++a) {
            if (!usable(k, a))
                continue;
            const SlidingNode &here = nodes[size_t(k)], &next = nodes[size_t(k) + 1];
            for (int b = 0; b < places; ++b) {
                const double cells = 1 + double(b - a) / middle * reach; // from node k to the next
                if (!usable(k + 1, b) || cells < least_spacing)
                    continue;
                const Eigen::Vector2d edge = next.place[size_t(b)] - here.place[size_t(a)];
                if (edge.norm() == 0)
                    continue;
                const Eigen::Vector2d out = edge.normalized();
                const double uneven = (cells - 1) * (cells - 1);
                Best& state = best[size_t(k)][size_t(a)][size_t(b)];
                if (k == 0) {
                    state = {uneven, -1, b};
                    continue;
                }
                for (int c = 0; c < places; ++c) {
                    const Best& before = best[size_t(k) - 1][size_t(c)][size_t(a)];
                    if (before.cost >= impossible)
                        continue;
                    const Eigen::Vector2d in =
                        (here.place[size_t(a)] - nodes[size_t(k) - 1].place[size_t(c)]).normalized();
                    double cost = before.cost + uneven + bend(in, out, here.corner);
                    if (k == n - 1)
                        cost += bend(out, (nodes[1].place[size_t(before.second)] - nodes[0].place[middle]).normalized(),
                                     true);
                    if (cost < state.cost)
                        state = {cost, c, before.second};
                }
            }
        }
    int a = -1, b = middle;
    for (int c = 0; c < places; ++c)
        if (a < 0 || best[size_t(n) - 1][size_t(c)][middle].cost < best[size_t(n) - 1][size_t(a)][middle].cost)
            a = c;
    if (best[size_t(n) - 1][size_t(a)][middle].cost >= impossible)
        return result;
    for (int k = n - 1; k > 0; --k) {
        const SlidingNode& node = nodes[size_t(k)];
        if (!node.corner)
            result[size_t(node.side)][node.index] = node.parameter(a, node.side % 2 == 0 ? columns : rows, reach);
        const int before = best[size_t(k)][size_t(a)][size_t(b)].from;
        b = a;
        a = before;
    }
    return result;
}

void place_border(const FilledMesh& filled, const BlankBoundary& boundary, const BorderParameters& parameters,
                  QuadGrid& grid, std::vector<MeshPoint>& place)
{
    const std::vector<int> face = faces_along(filled);
    for (int k = 0; k < 4; ++k) {
        const std::vector<int>& side = boundary.side[size_t(k)];
        const Eigen::VectorXd chord = chord_parameters(side, filled.plane);
        const int cells = k % 2 == 0 ? grid.columns : grid.rows;
        for (int i = 0; i < cells; ++i) { // the last node of a side is the first one of the next
            const std::array<int, 4> nodes = {grid.node(i, 0), grid.node(grid.columns, i),
                                              grid.node(grid.columns - i, grid.rows), grid.node(0, grid.rows - i)};
            const int node = nodes[size_t(k)];
            const SidePoint on_side = point_on_side(side, chord, parameters[size_t(k)][i]);
            MeshPoint& here = place[size_t(node)];
            here = {face[size_t(on_side.a)], Eigen::Vector3d::Zero(), 0};
            here.barycentric[filled.mesh.corner_of(here.face, on_side.a)] = 1 - on_side.weight;
            here.barycentric[filled.mesh.corner_of(here.face, on_side.b)] = on_side.weight;
            grid.position.col(node) << position(on_side, filled.plane), 0;
        }
    }
}

} // namespace spia
