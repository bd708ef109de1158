#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/layout/plane_graph.h"
#include "engine/mesh/edge_graph.h"
#include "engine/mesh/topology.h"
#include "engine/remesh/kept_lines.h"

namespace spia {

namespace {

using std::numbers::pi;
constexpr double shortest = 0.02; ///< over the diagonal: loose ends below it are no edges but noise
                                  ///< of the mesh
constexpr size_t most_lines =
    200; ///< more of them: only sharper ones count, or it is a rough surface, not a part with edges
constexpr double rough = pi / 4; ///< the angle from which on too many are too many
constexpr double most_turn = 100 * pi / 180;

/// Radians that the line has turned at each of its vertices, and its length so far.
struct Progression {
    std::vector<double> turn, length;
};

Progression along(const std::vector<int>& row, const Eigen::Matrix2Xd& plane)
{
    Progression result{{0}, {0}};
    for (size_t i = 1; i < row.size(); ++i) {
        const Eigen::Vector2d d = plane.col(row[i]) - plane.col(row[i - 1]);
        double turn = 0;
        if (i > 1) {
            const Eigen::Vector2d before = plane.col(row[i - 1]) - plane.col(row[i - 2]);
            turn = std::abs(std::atan2(before.x() * d.y() - before.y() * d.x(), before.dot(d)));
        }
        result.turn.push_back(result.turn.back() + turn);
        result.length.push_back(result.length.back() + d.norm());
    }
    return result;
}

/// The row in pieces that neither wind nor are longer than that: a closed one in four or more.
std::vector<std::vector<int>> pieces_of(const std::vector<int>& row, const Eigen::Matrix2Xd& plane, double longest)
{
    const Progression so_far = along(row, plane);
    const int by_length = int(std::lround(so_far.length.back() / longest)),
              by_turn = int(std::ceil(so_far.turn.back() / most_turn - 1e-9));
    const int least = row.front() == row.back() ? 4 : 1; // where it closes it may turn as well
    const int count = std::min(int(row.size()) - 1, std::max({least, by_length, by_turn}));
    std::vector<std::vector<int>> result;
    size_t from = 0;
    for (int k = 1; k <= count; ++k) {
        size_t to = row.size() - 1;
        if (k < count) {
            const double there = so_far.length.back() * k / count;
            to = size_t(std::lower_bound(so_far.length.begin(), so_far.length.end(), there) - so_far.length.begin());
            to = std::clamp(to, from + 1, row.size() - 1 - size_t(count - k));
        }
        result.emplace_back(row.begin() + long(from), row.begin() + long(to) + 1);
        from = to;
    }
    return result;
}

} // namespace

std::vector<std::vector<int>> sharp_edges(const TriMesh& part, double angle)
{
    const double never = 2 * pi;
    const EdgeGraph graph = edge_graph(part);
    for (;; angle = std::min(1.25 * angle, std::max(angle, rough))) {
        const KeptLines lines = kept_lines(part, {}, angle, never, shortest * bounding_diagonal(part));
        std::vector<std::vector<int>> result;
        for (const std::vector<int>& row : lines.line)
            if (!graph.edge[size_t(graph.find(row[0], row[1]))].boundary())
                result.push_back(row);
        if (result.size() <= most_lines)
            return result;
        if (angle >= rough)
            return {};
    }
}

namespace {

/// A face between an edge and one arc of the border would have two sides.
void divide_arcs_beside_edges(PlaneGraph& graph)
{
    const size_t count = graph.curve.size();
    for (size_t e = 0; e < count; ++e)
        for (size_t c = 0; graph.curve[e].kept && c < count; ++c) {
            const LayoutCurve &edge = graph.curve[e], &arc = graph.curve[c];
            if (arc.on_border() && arc.plane.cols() > 2 &&
                (arc.vertex == edge.vertex || arc.vertex == std::array{edge.vertex[1], edge.vertex[0]}))
                split_curve(graph, int(c), next_to_middle(arc));
        }
}

} // namespace

void add_edges(PlaneGraph& graph, const Blank& blank, const std::vector<std::vector<int>>& edges, double longest)
{
    const auto vertex_at = [&](int v) {
        const Eigen::Vector2d place = blank.position.col(v);
        const auto found = std::find(graph.vertex.begin(), graph.vertex.end(), place);
        if (found != graph.vertex.end())
            return int(found - graph.vertex.begin());
        graph.vertex.push_back(place);
        graph.border.push_back(std::nullopt);
        return int(graph.vertex.size()) - 1;
    };
    for (const std::vector<int>& edge : edges)
        for (const std::vector<int>& piece : pieces_of(edge, blank.position, longest)) {
            LayoutCurve curve;
            curve.vertex = {vertex_at(piece.front()), vertex_at(piece.back())};
            curve.plane = blank.position(Eigen::all, piece);
            curve.kept = true;
            graph.curve.push_back(std::move(curve));
        }
    divide_arcs_beside_edges(graph);
}

} // namespace spia
