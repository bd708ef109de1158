#include "engine/unfold/plan/label_graph.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "engine/core/error.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_uses.h"

namespace spia {

std::vector<std::vector<int>> labels_of_vertices(const TriMesh& part, const BendMap& map)
{
    std::vector<std::vector<int>> labels(size_t(part.vertices()));
    for (int f = 0; f < part.triangles(); ++f)
        for (const int v : part.triangle.col(f))
            labels[size_t(v)].push_back(map.label[f]);
    for (auto& each : labels) {
        std::sort(each.begin(), each.end());
        each.erase(std::unique(each.begin(), each.end()), each.end());
    }
    return labels;
}

LabelGraph label_graph(const TriMesh& part, const BendMap& map, const std::vector<std::vector<int>>& of_vertex)
{
    const auto count = size_t(map.label.maxCoeff() + 1);
    LabelGraph graph{std::vector<std::map<int, double>>(count), std::vector<std::set<int>>(count)};
    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        const int a = map.label[uses[begin].face], b = map.label[uses[end - 1].face];
        if (a == b)
            return;
        const double length = (part.position.col(uses[begin].low) - part.position.col(uses[begin].high)).norm();
        graph.edge[size_t(a)][b] += length;
        graph.edge[size_t(b)][a] += length;
    });
    for (const auto& labels : of_vertex)
        for (const int a : labels)
            for (const int b : labels)
                if (a != b)
                    graph.vertex[size_t(a)].insert(b);
    return graph;
}

std::vector<int> depths(const BendMap& map, const LabelGraph& graph, int root)
{
    constexpr double curl = 0.5;
    const int none = std::numeric_limits<int>::max(), regions = int(map.regions.size());
    // A bend leads from one of its two regions to the other; that bends touch at the corners of
    // walls leads nowhere.
    const auto joins = [&](int bend, int region) {
        const Bend& between = map.bends[size_t(bend - regions)];
        return between.a == region || between.b == region;
    };
    const auto leads = [&](int a, int b) {
        return a < regions ? b < regions || joins(b, a) : b < regions && joins(a, b);
    };
    std::vector<int> way(graph.edge.size(), none);
    way[size_t(root)] = 0;
    for (const bool anyhow : {false, true}) { // what is reached in no such way is reached over
                                              // whatever touches
        std::deque<int> queue;
        for (int label = 0; label < int(way.size()); ++label)
            if (way[size_t(label)] != none)
                queue.push_back(label);
        std::stable_sort(queue.begin(), queue.end(), [&](int a, int b) { return way[size_t(a)] < way[size_t(b)]; });
        while (!queue.empty()) {
            const int a = queue.front();
            queue.pop_front();
            for (const auto& [b, length] : graph.edge[size_t(a)]) {
                const int cost = way[size_t(a)] + (b < regions ? 1 : 0);
                if (cost >= way[size_t(b)] || !(leads(a, b) || (anyhow && way[size_t(b)] == none)))
                    continue;
                way[size_t(b)] = cost;
                b < regions ? queue.push_back(b) : queue.push_front(b);
            }
        }
    }
    if (std::find(way.begin(), way.end(), none) != way.end())
        throw InputError("the part is in several pieces; keep one of them");
    std::vector<int> depth = way;
    for (int label = regions; label < int(depth.size()); ++label) {
        const Bend& bend = map.bends[size_t(label - regions)];
        depth[size_t(label)] = bend.b >= 0 ? std::max(way[size_t(bend.a)], way[size_t(bend.b)])
                                           : way[size_t(bend.a)] + (std::abs(bend.angle) >= curl ? 1 : 0);
    }
    return depth;
}

std::vector<std::vector<int>> clusters(const LabelGraph& graph, const std::vector<int>& depth, int least)
{
    DisjointSets sets(depth.size());
    for (size_t a = 0; a < depth.size(); ++a)
        for (const int b : graph.vertex[a])
            if (depth[a] >= least && depth[size_t(b)] >= least)
                sets.join(int(a), b);
    std::map<int, std::vector<int>> found;
    for (size_t a = 0; a < depth.size(); ++a)
        if (depth[a] >= least)
            found[sets.root(int(a))].push_back(int(a));
    std::vector<std::vector<int>> result;
    for (auto& [first, labels] : found)
        result.push_back(std::move(labels));
    return result;
}

} // namespace spia
