#include "engine/mesh/cut/handle_cut.h"

#include <algorithm>
#include <numeric>

#include "engine/mesh/disjoint_sets.h"

namespace spia {
namespace {

/// Takes away, again and again, edges that end inside the part: they separate nothing.
void prune(const EdgeGraph& graph, std::vector<char>& cut)
{
    std::vector<int> degree(size_t(graph.vertices()), 0);
    for (size_t e = 0; e < cut.size(); ++e)
        if (cut[e]) {
            ++degree[size_t(graph.edge[e].low)];
            ++degree[size_t(graph.edge[e].high)];
        }
    for (int start = 0; start < graph.vertices(); ++start)
        for (int v = start; v >= 0 && degree[size_t(v)] == 1 && !graph.on_rim[size_t(v)];) {
            int next = -1;
            for (int i = graph.first[size_t(v)]; i < graph.first[size_t(v) + 1]; ++i)
                if (const int e = graph.at[size_t(i)]; cut[size_t(e)]) {
                    cut[size_t(e)] = 0;
                    next = graph.edge[size_t(e)].other(v);
                    --degree[size_t(next)];
                }
            degree[size_t(v)] = 0;
            v = next;
        }
}

/// The greedy cut graph from one base: a vertex, or all vertices of a boundary loop.
/// @param loop_of per vertex its boundary loop, -1 inside
std::vector<char> greedy_cut(const EdgeGraph& graph, const std::vector<int>& base, const std::vector<int>& loop_of,
                             int loops, int triangles)
{
    // A boundary loop that is the base is one single point: its edges lie in the tree, all but one.
    const EdgePaths paths = shortest_paths(graph, base, RimCost::none);
    std::vector<char> in_tree(graph.edge.size(), 0);
    for (const int e : paths.edge)
        if (e >= 0)
            in_tree[size_t(e)] = 1;
    for (size_t i = 1; base.size() > 1 && i < base.size(); ++i)
        in_tree[size_t(graph.find(base[i - 1], base[i]))] = 1;

    // The longest cotree takes the edges with the longest loops first. Holes are faces, too: they
    // are capped.
    const auto loop_length = [&](int e) {
        const EdgeGraph::Edge& edge = graph.edge[size_t(e)];
        return paths.distance[size_t(edge.low)] + paths.distance[size_t(edge.high)] +
               (edge.boundary() ? 0 : edge.length);
    };
    std::vector<int> order(graph.edge.size());
    std::iota(order.begin(), order.end(), 0);
    std::erase_if(order, [&](int e) { return in_tree[size_t(e)]; });
    std::vector<double> length(graph.edge.size());
    for (const int e : order)
        length[size_t(e)] = loop_length(e);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return length[size_t(a)] > length[size_t(b)]; });
    DisjointSets cotree(size_t(triangles) + size_t(loops));
    std::vector<char> cut(graph.edge.size(), 0);
    for (const int e : order) {
        const EdgeGraph::Edge& edge = graph.edge[size_t(e)];
        const int beyond = edge.boundary() ? triangles + loop_of[size_t(edge.low)] : edge.twin;
        if (cotree.root(edge.face) != cotree.root(beyond)) {
            cotree.join(edge.face, beyond);
            continue;
        }
        cut[size_t(e)] = 1; // in neither: 2 per handle
        for (int v : {edge.low, edge.high})
            for (int back = paths.edge[size_t(v)]; back >= 0; back = paths.edge[size_t(v)]) {
                cut[size_t(back)] = 1;
                v = graph.edge[size_t(back)].other(v);
            }
    }
    for (size_t e = 0; e < cut.size(); ++e)
        if (graph.edge[e].boundary())
            cut[e] = 0;
    prune(graph, cut);
    return cut;
}

} // namespace

std::vector<int> handle_cut(const EdgeGraph& graph, const std::vector<std::vector<int>>& loops, int triangles,
                            int genus)
{
    std::vector<int> loop_of(size_t(graph.vertices()), -1);
    for (size_t l = 0; l < loops.size(); ++l)
        for (const int v : loops[l])
            loop_of[size_t(v)] = int(l);
    // a second or two for a large part
    constexpr int most_visits = 4'000'000, least_bases = 6, most_bases = 48;
    const int count = std::clamp(most_visits / (graph.vertices() * genus), least_bases, most_bases);
    std::vector<std::vector<int>> bases(loops.begin(), loops.begin() + std::min<long>(long(loops.size()), count / 2));
    while (int(bases.size()) < count)
        bases.push_back({int(long(bases.size()) * graph.vertices() / count)});

    double shortest = 0;
    std::vector<char> best;
    for (const std::vector<int>& base : bases) {
        std::vector<char> cut = greedy_cut(graph, base, loop_of, int(loops.size()), triangles);
        double length = 0;
        for (size_t e = 0; e < cut.size(); ++e)
            length += cut[e] ? graph.edge[e].length : 0;
        if (best.empty() || length < shortest) {
            shortest = length;
            best = std::move(cut);
        }
    }
    std::vector<int> edges;
    for (size_t e = 0; e < best.size(); ++e)
        if (best[e])
            edges.push_back(int(e));
    return edges;
}

} // namespace spia
