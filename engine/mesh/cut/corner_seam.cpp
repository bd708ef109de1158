#include "engine/mesh/cut/corner_seam.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/mesh/curvature.h"
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_graph.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

constexpr double corner = 0.5; // radians; less is one of many along a crease, as where a collar
                               // stands up from a plate, and so cut the sheet would overlap
constexpr double ring = 0.1; // radians, of a row of vertices, too; a washer of 10 degrees of slope can as well be drawn
constexpr double unrolls = 0.02; // radians, all together: bent parts measured have 0 to rounding,
                                 // drawn ones 0.9 and more

/// Openings that are no holes in sheet that unrolls. @param loops of the border, the outline first
std::vector<std::vector<int>> rings(const TriMesh& part, const std::vector<std::vector<int>>& loops)
{
    const std::vector<double> turning = turnings(part, loops);
    std::vector<std::vector<int>> result;
    for (size_t k = 1; k < loops.size(); ++k)
        if (std::abs(turning[k] + 2 * std::numbers::pi) > ring)
            result.push_back(loops[k]);
    return result;
}

/// Where a part holds curvature: a vertex, or vertices in a row.
using Rows = std::vector<std::vector<int>>;

/// Each by itself.
Rows single_corners(const Eigen::VectorXd& defect)
{
    Rows rows;
    for (int v = 0; v < defect.size(); ++v)
        if (std::abs(defect[v]) > corner)
            rows.push_back({v});
    return rows;
}

/// Those that edges join: rounded bends of walls that are joined meet along a mitre, which holds
/// what lacks little by little. A ring of them is the foot of a collar, which no cut lets unroll.
/// @returns nothing where one is a ring, or forks
Rows mitres(const EdgeGraph& graph, const Eigen::VectorXd& defect)
{
    constexpr double holds = 1e-3; // radians
    std::vector<int> edges;
    for (int e = 0; e < int(graph.edge.size()); ++e)
        if (std::abs(defect[graph.edge[size_t(e)].low]) > holds && std::abs(defect[graph.edge[size_t(e)].high]) > holds)
            edges.push_back(e);
    // The shortest edges that join them all: a chord over a vertex of a row is longer, and what
    // leads from one row to another, along a bend, much longer.
    std::ranges::stable_sort(edges, {}, [&](int e) { return graph.edge[size_t(e)].length; });
    DisjointSets together(size_t(defect.size()));
    std::erase_if(edges, [&](int e) {
        const EdgeGraph::Edge& edge = graph.edge[size_t(e)];
        const bool known = together.root(edge.low) == together.root(edge.high);
        together.join(edge.low, edge.high);
        return known;
    });
    constexpr double much = 4; // of the median
    std::vector<std::vector<int>> next(size_t(defect.size()));
    for (const int e : edges)
        if (const EdgeGraph::Edge& edge = graph.edge[size_t(e)];
            edge.length <= much * graph.edge[size_t(edges[edges.size() / 2])].length) {
            next[size_t(edge.low)].push_back(edge.high);
            next[size_t(edge.high)].push_back(edge.low);
        }
    Rows rows;
    std::vector<char> taken(size_t(defect.size()), 0);
    for (int v = 0; v < defect.size(); ++v) {
        if (next[size_t(v)].size() > 2)
            return {};
        if (std::abs(defect[v]) <= holds || next[size_t(v)].size() == 2 || taken[size_t(v)])
            continue;
        std::vector<int> row{v};
        taken[size_t(v)] = 1;
        for (int at = v; at >= 0;) {
            const auto& on = next[size_t(at)];
            const auto to = std::ranges::find_if(on, [&](int w) { return !taken[size_t(w)]; });
            at = to == on.end() ? -1 : *to;
            if (at >= 0) {
                taken[size_t(at)] = 1;
                row.push_back(at);
            }
        }
        if (row.size() > 2 && graph.find(row.front(), row.back()) >= 0)
            return {};
        double lacks = 0;
        for (const int w : row)
            lacks += defect[w];
        if (std::abs(lacks) > ring)
            rows.push_back(std::move(row));
    }
    return rows;
}

/// The cuts along such rows and on to the outline; nothing if the part would not unroll then.
std::optional<CornerSeam> seam_of(const TriMesh& part, const EdgeGraph& graph, const Eigen::VectorXd& defect, Rows rows)
{
    constexpr size_t most = 64;
    const std::vector<std::vector<int>> loops = boundary_loops(part);
    const std::vector<std::vector<int>> opening = rings(part, loops);
    if (rows.size() + opening.size() == 0 || rows.size() + opening.size() > most)
        return std::nullopt;
    CornerSeam seam;
    for (const double turning : turnings(part, opening))
        seam.defect = std::max(seam.defect, std::abs(turning + 2 * std::numbers::pi));
    const EdgePaths ways = shortest_paths(graph, loops.front(), RimCost::as_long_as_it_is);
    const auto far = [&](int v) { return ways.distance[size_t(v)]; };
    for (const std::vector<int>& loop : opening) {
        seam.opening.push_back(*std::ranges::min_element(loop, {}, far));
        rows.push_back({seam.opening.back()});
    }
    std::set<std::array<int, 2>> edges; // ways may run together
    for (std::vector<int>& row : rows) {
        if (far(row.front()) < far(row.back()))
            std::ranges::reverse(row);
        if (seam.path.size() < rows.size() - opening.size()) {
            double lacks = 0;
            for (const int v : row)
                lacks += defect[v];
            seam.corner.push_back(row.back());
            seam.defect = std::max(seam.defect, std::abs(lacks));
        }
        std::vector<int> path = path_to(graph, ways, row.back());
        std::ranges::reverse(path);
        path.insert(path.begin(), row.begin(), row.end() - 1);
        for (size_t i = 0; i + 1 < path.size(); ++i)
            if (edges.insert({std::min(path[i], path[i + 1]), std::max(path[i], path[i + 1])}).second)
                seam.length += (part.position.col(path[i + 1]) - part.position.col(path[i])).norm();
        seam.path.push_back(std::move(path));
    }
    const CutPart cut = cut_along(part, std::vector(edges.begin(), edges.end()));
    if (!surface_type(cut.mesh).sheet() || angle_defects(cut.mesh).cwiseAbs().sum() > unrolls ||
        !rings(cut.mesh, boundary_loops(cut.mesh)).empty())
        return std::nullopt;
    return seam;
}

} // namespace

std::optional<CornerSeam> corner_seam(const TriMesh& part)
{
    if (boundary_loops(part).empty())
        return std::nullopt;
    const Eigen::VectorXd defect = angle_defects(part);
    const EdgeGraph graph = edge_graph(part);
    auto seam = seam_of(part, graph, defect, single_corners(defect));
    return seam ? seam : seam_of(part, graph, defect, mitres(graph, defect));
}

} // namespace spia
