#include "engine/unfold/plan/bend_networks.h"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <tuple>

#include "engine/mesh/disjoint_sets.h"
#include "engine/unfold/plan/label_measures.h"

namespace spia {

Ways ways_from_regions(const TriMesh& part, const SheetTurns& turns, const std::vector<int>& region)
{
    struct Visit {
        double length;
        int face, from, edge, before;
        bool operator>(const Visit& o) const
        {
            return std::tie(length, face, from, edge) > std::tie(o.length, o.face, o.from, o.edge);
        }
    };
    std::priority_queue<Visit, std::vector<Visit>, std::greater<>> queue;
    // to the edge
    const auto step = [&](int f, int e) { return turns.height(turns.edge[size_t(e)], f) / 3; };
    for (int e = 0; e < int(turns.edge.size()); ++e) {
        const EdgeTurn& edge = turns.edge[size_t(e)];
        for (const auto& [f, g] : {std::pair(edge.face, edge.twin), std::pair(edge.twin, edge.face)})
            if (region[size_t(f)] >= 0 && region[size_t(g)] < 0)
                queue.push({step(g, e), g, region[size_t(f)], e, f});
    }
    Ways ways(region.size());
    while (!queue.empty()) {
        const Visit now = queue.top();
        queue.pop();
        std::array<Way, 2>& here = ways[size_t(now.face)];
        if (here[0].region == now.from || here[1].region >= 0)
            continue;
        here[here[0].region < 0 ? 0 : 1] = {now.from, now.length, now.edge, now.before};
        for (int k = turns.first[size_t(now.face)]; k < turns.first[size_t(now.face) + 1]; ++k) {
            const int e = turns.at[size_t(k)];
            const EdgeTurn& edge = turns.edge[size_t(e)];
            const int g = edge.face == now.face ? edge.twin : edge.face;
            if (region[size_t(g)] >= 0)
                continue;
            queue.push({now.length + (middle(part, g) - middle(part, now.face)).norm(), g, now.from, e, now.face});
        }
    }
    return ways;
}

std::vector<int> split_networks(const SheetTurns& turns, const std::vector<int>& region, const Ways& ways, double least,
                                std::vector<std::pair<int, int>>& pairs)
{
    const auto pair = [&](int f) {
        const int a = ways[size_t(f)][0].region, b = ways[size_t(f)][1].region;
        return b < 0 ? std::pair(a, b) : std::minmax({a, b});
    };
    const int count = int(region.size());
    std::vector<std::pair<int, int>> of(region.size());
    for (int f = 0; f < count; ++f)
        of[size_t(f)] = pair(f);
    std::vector<int> number(region.size(), -1);
    for (;;) {
        DisjointSets sets(region.size());
        const auto both_bent = [&](const EdgeTurn& e) {
            return region[size_t(e.face)] < 0 && region[size_t(e.twin)] < 0;
        };
        for (const EdgeTurn& e : turns.edge)
            if (both_bent(e) && of[size_t(e.face)] == of[size_t(e.twin)])
                sets.join(e.face, e.twin);
        std::map<int, double> area;
        for (int f = 0; f < count; ++f)
            if (region[size_t(f)] < 0)
                area[sets.root(f)] += turns.area[f];
        std::map<int, std::map<int, double>> border;
        for (const EdgeTurn& e : turns.edge)
            if (both_bent(e))
                if (const int p = sets.root(e.face), q = sets.root(e.twin); p != q) {
                    border[p][q] += e.length;
                    border[q][p] += e.length;
                }
        int smallest = -1;
        for (const auto& [p, size] : area)
            if (size < least && border.count(p) && (smallest < 0 || size < area[smallest]))
                smallest = p;
        if (smallest < 0) {
            std::map<int, int> numbers;
            for (const auto& [p, size] : area) {
                numbers[p] = int(pairs.size());
                pairs.push_back(of[size_t(p)]);
            }
            for (int f = 0; f < count; ++f)
                if (region[size_t(f)] < 0)
                    number[size_t(f)] = numbers[sets.root(f)];
            return number;
        }
        const auto& beside = border[smallest];
        const int to = std::max_element(beside.begin(), beside.end(), [](const auto& x, const auto& y) {
                           return x.second < y.second;
                       })->first;
        const auto taken = of[size_t(to)];
        std::vector<int> moved;
        for (int f = 0; f < count; ++f)
            if (region[size_t(f)] < 0 && sets.root(f) == smallest)
                moved.push_back(f);
        for (const int f : moved)
            of[size_t(f)] = taken;
    }
}

} // namespace spia
