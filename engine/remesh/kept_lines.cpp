#include "engine/remesh/kept_lines.h"

#include <Eigen/Geometry>
#include <cmath>

#include "engine/mesh/edge_graph.h"
#include "engine/mesh/topology.h"
#include "engine/mesh/vectors.h"

namespace spia {
namespace {

std::vector<char> kept_edges(const TriMesh& mesh, const EdgeGraph& graph, std::span<const int> label, double angle)
{
    const Eigen::Matrix3Xd normal = area_vectors(mesh);
    std::vector<char> kept;
    for (const EdgeGraph::Edge& edge : graph.edge)
        kept.push_back(edge.boundary() || (!label.empty() && label[size_t(edge.face)] != label[size_t(edge.twin)]) ||
                       angle_between(normal.col(edge.face), normal.col(edge.twin)) > angle);
    return kept;
}

/// Edges between faces at more than that angle, both wide enough to be divided for themselves.
std::vector<char> ridges(const TriMesh& mesh, const EdgeGraph& graph, double angle, double size)
{
    constexpr double least_width = 0.4; // of the size
    const Eigen::Matrix3Xd normal = area_vectors(mesh);
    std::vector<char> result;
    for (const EdgeGraph::Edge& edge : graph.edge)
        result.push_back(!edge.boundary() && angle_between(normal.col(edge.face), normal.col(edge.twin)) > angle &&
                         2 * std::min(normal.col(edge.face).norm(), normal.col(edge.twin).norm()) >
                             least_width * size * edge.length);
    return result;
}

std::vector<int> kept_at(const EdgeGraph& graph, const std::vector<char>& kept, int v)
{
    std::vector<int> edges;
    for (int i = graph.first[size_t(v)]; i < graph.first[size_t(v) + 1]; ++i)
        if (kept[size_t(graph.at[size_t(i)])])
            edges.push_back(graph.at[size_t(i)]);
    return edges;
}

/// Where a surface is curved both ways, or its edges cross a bend, ridges fork: there they say
/// nothing of a bend.
void keep_without_forks(const EdgeGraph& graph, const std::vector<char>& ridge, std::vector<char>& kept)
{
    std::vector<char> forked(size_t(graph.vertices()), 0);
    for (int v = 0; v < graph.vertices(); ++v)
        forked[size_t(v)] = kept_at(graph, ridge, v).size() > 2;
    for (size_t e = 0; e < kept.size(); ++e)
        if (!kept[e] && ridge[e] && !forked[size_t(graph.edge[e].low)] && !forked[size_t(graph.edge[e].high)])
            kept[e] = 2;
}

/// Takes away lines with a loose end that are shorter than that: the normal of a sliver makes an
/// edge look sharp.
void prune(const EdgeGraph& graph, double shortest, std::vector<char>& kept)
{
    constexpr int most_rounds = 3; // a fork becomes a loose end
    bool again = true;
    for (int round = 0; round < most_rounds && again; ++round) {
        again = false;
        for (int v = 0; v < graph.vertices(); ++v) {
            std::vector<int> row, next = kept_at(graph, kept, v);
            if (next.size() != 1)
                continue;
            double length = 0;
            for (int at = v; length < shortest;) {
                row.push_back(next[0]);
                length += graph.edge[size_t(next[0])].length;
                at = graph.edge[size_t(next[0])].other(at);
                next = kept_at(graph, kept, at);
                if (next.size() != 2)
                    break;
                if (next[0] == row.back())
                    std::swap(next[0], next[1]);
            }
            if (length >= shortest)
                continue;
            for (const int edge : row)
                kept[size_t(edge)] = 0;
            again = true;
        }
    }
}

/// Follows kept edges from one vertex until a corner, or back to the start.
std::vector<int> follow(const EdgeGraph& graph, int start, int edge, const std::vector<char>& kept,
                        const std::vector<char>& corner, std::vector<char>& used)
{
    std::vector<int> row = {start};
    for (int at = start; edge >= 0;) {
        used[size_t(edge)] = 1;
        at = graph.edge[size_t(edge)].other(at);
        row.push_back(at);
        edge = -1;
        if (corner[size_t(at)] || at == start)
            break;
        for (int i = graph.first[size_t(at)]; i < graph.first[size_t(at) + 1]; ++i)
            if (const int next = graph.at[size_t(i)]; kept[size_t(next)] && !used[size_t(next)])
                edge = next;
    }
    return row;
}

} // namespace

KeptLines kept_lines(const TriMesh& mesh, std::span<const int> label, double angle, double ridge, double size)
{
    const EdgeGraph graph = edge_graph(mesh);
    std::vector<char> kept = kept_edges(mesh, graph, label, angle);
    keep_without_forks(graph, ridges(mesh, graph, ridge, size), kept);
    prune(graph, size, kept);
    const size_t n = size_t(mesh.vertices());
    KeptLines result{{}, std::vector<char>(n, 0), std::vector<char>(n, 0), kept};
    for (int v = 0; v < mesh.vertices(); ++v) {
        const std::vector<int> edges = kept_at(graph, kept, v);
        result.on_line[size_t(v)] = !edges.empty();
        if (edges.size() == 2) {
            const Eigen::Vector3d here = mesh.position.col(v);
            const Eigen::Vector3d in = here - mesh.position.col(graph.edge[size_t(edges[0])].other(v));
            const Eigen::Vector3d out = mesh.position.col(graph.edge[size_t(edges[1])].other(v)) - here;
            result.corner[size_t(v)] = angle_between(in, out) > angle;
        } else
            result.corner[size_t(v)] = !edges.empty();
    }
    std::vector<char> used(graph.edge.size(), 0);
    for (const bool from_corners : {true, false}) // what is left after the corners are closed lines
        for (int v = 0; v < mesh.vertices(); ++v)
            if (!from_corners || result.corner[size_t(v)])
                for (const int edge : kept_at(graph, kept, v))
                    if (!used[size_t(edge)])
                        result.line.push_back(follow(graph, v, edge, kept, result.corner, used));
    return result;
}

} // namespace spia
