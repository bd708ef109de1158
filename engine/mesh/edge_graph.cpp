#include "engine/mesh/edge_graph.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>

#include "engine/mesh/edge_uses.h"

namespace spia {

int EdgeGraph::find(int a, int b) const
{
    for (int i = first[size_t(a)]; i < first[size_t(a) + 1]; ++i)
        if (edge[size_t(at[size_t(i)])].other(a) == b)
            return at[size_t(i)];
    return -1;
}

EdgeGraph edge_graph(const TriMesh& mesh)
{
    EdgeGraph graph;
    graph.on_rim.assign(size_t(mesh.vertices()), 0);
    graph.first.assign(size_t(mesh.vertices()) + 1, 0);
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        const int a = uses[begin].low, b = uses[begin].high;
        graph.edge.push_back({a, b, uses[begin].face, end - begin > 1 ? uses[begin + 1].face : -1,
                              (mesh.position.col(a) - mesh.position.col(b)).norm()});
        ++graph.first[size_t(a) + 1];
        ++graph.first[size_t(b) + 1];
        if (graph.edge.back().boundary())
            graph.on_rim[size_t(a)] = graph.on_rim[size_t(b)] = 1;
    });
    for (size_t v = 1; v < graph.first.size(); ++v)
        graph.first[v] += graph.first[v - 1];
    graph.at.resize(2 * graph.edge.size());
    std::vector<int> next(graph.first.begin(), graph.first.end() - 1);
    for (size_t e = 0; e < graph.edge.size(); ++e) {
        graph.at[size_t(next[size_t(graph.edge[e].low)]++)] = int(e);
        graph.at[size_t(next[size_t(graph.edge[e].high)]++)] = int(e);
    }
    return graph;
}

EdgePaths shortest_paths(const EdgeGraph& graph, const std::vector<int>& sources, RimCost rim,
                         const std::vector<char>& target)
{
    EdgePaths result;
    result.distance.assign(size_t(graph.vertices()), std::numeric_limits<double>::infinity());
    result.edge.assign(size_t(graph.vertices()), -1);
    std::vector<char> done(size_t(graph.vertices()), 0);
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
    for (const int v : sources) {
        result.distance[size_t(v)] = 0;
        open.emplace(0, v);
    }
    std::vector<int> settled;
    while (!open.empty()) {
        settled.push_back(open.top().second);
        open.pop();
        if (std::exchange(done[size_t(settled.back())], char(1)))
            settled.clear();
        // A rim that costs nothing is reached as a whole, by one way only: else two ways of the
        // same length to it would enclose a piece of the part.
        while (!settled.empty()) {
            const int v = settled.back();
            settled.pop_back();
            if (!target.empty() && target[size_t(v)] && result.edge[size_t(v)] >= 0) {
                result.reached = v;
                return result;
            }
            for (int i = graph.first[size_t(v)]; i < graph.first[size_t(v) + 1]; ++i) {
                const int e = graph.at[size_t(i)];
                const EdgeGraph::Edge& edge = graph.edge[size_t(e)];
                const int to = edge.other(v);
                const bool free = edge.boundary() && rim == RimCost::none;
                const double way = result.distance[size_t(v)] + (free ? 0 : edge.length);
                if (done[size_t(to)] || (!free && way >= result.distance[size_t(to)]))
                    continue;
                result.distance[size_t(to)] = way;
                result.edge[size_t(to)] = e;
                if (free) {
                    done[size_t(to)] = 1;
                    settled.push_back(to);
                } else
                    open.emplace(way, to);
            }
        }
    }
    return result;
}

std::vector<int> path_to(const EdgeGraph& graph, const EdgePaths& paths, int v)
{
    std::vector<int> path{v};
    for (int e = paths.edge[size_t(v)]; e >= 0; e = paths.edge[size_t(v)]) {
        v = graph.edge[size_t(e)].other(v);
        path.push_back(v);
    }
    std::reverse(path.begin(), path.end());
    return path;
}

} // namespace spia
