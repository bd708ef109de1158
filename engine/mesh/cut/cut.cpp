#include "engine/mesh/cut/cut.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/core/error.h"
#include "engine/mesh/curvature.h"
#include "engine/mesh/cut/handle_cut.h"
#include "engine/mesh/cut/ring_strain.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/edge_graph.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// The marked edges as rows of vertices: from each crossing or end to the next, then the closed
/// rows that are left.
std::vector<std::vector<int>> rows_of(const EdgeGraph& graph, std::vector<char> cut)
{
    std::vector<int> degree(size_t(graph.vertices()), 0);
    for (size_t e = 0; e < cut.size(); ++e)
        if (cut[e]) {
            ++degree[size_t(graph.edge[e].low)];
            ++degree[size_t(graph.edge[e].high)];
        }
    const auto leave = [&](int v) { // along the first marked edge; -1 if there is none
        for (int i = graph.first[size_t(v)]; i < graph.first[size_t(v) + 1]; ++i)
            if (const int e = graph.at[size_t(i)]; std::exchange(cut[size_t(e)], char(0)))
                return graph.edge[size_t(e)].other(v);
        return -1;
    };
    const auto node = [&](int v) { return degree[size_t(v)] != 2 || graph.on_rim[size_t(v)]; };
    std::vector<std::vector<int>> rows;
    for (const bool closed : {false, true})
        for (int start = 0; start < graph.vertices(); ++start) {
            if (degree[size_t(start)] == 0 || node(start) == closed)
                continue;
            for (int v = leave(start); v >= 0; v = leave(start)) {
                std::vector<int> row{start};
                for (; v >= 0; v = node(v) || v == start ? -1 : leave(v))
                    row.push_back(v);
                rows.push_back(std::move(row));
            }
        }
    return rows;
}

CutPart uncut(const TriMesh& part)
{
    CutPart result;
    result.mesh = part;
    result.source.resize(size_t(part.vertices()));
    std::iota(result.source.begin(), result.source.end(), 0);
    return result;
}

CutPart cut_edges(const TriMesh& part, const EdgeGraph& graph, std::vector<char> cut)
{
    // A vertex gets a copy for each fan of faces around it that no uncut edge joins to another.
    DisjointSets fan(3 * size_t(part.triangles()));
    const auto corner = [&](int face, int vertex) {
        const auto t = part.triangle.col(face);
        return 3 * face + (t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2);
    };
    CutPart result;
    for (size_t e = 0; e < cut.size(); ++e) {
        const EdgeGraph::Edge& edge = graph.edge[e];
        if (edge.boundary())
            cut[e] = 0; // open already
        else if (cut[e])
            result.length += edge.length;
        else
            for (const int v : {edge.low, edge.high})
                fan.join(corner(edge.face, v), corner(edge.twin, v));
    }
    std::vector<std::pair<int, int>> copies; // of the vertex, named by the least corner of the fan
    std::vector<int> number(3 * size_t(part.triangles()), -1);
    for (int c = 0; c < 3 * part.triangles(); ++c)
        if (fan.root(c) == c)
            copies.emplace_back(part.triangle(c % 3, c / 3), c);
    std::sort(copies.begin(), copies.end());
    result.mesh.position.resize(3, Eigen::Index(copies.size()));
    for (size_t i = 0; i < copies.size(); ++i) {
        number[size_t(copies[i].second)] = int(i);
        result.source.push_back(copies[i].first);
        result.mesh.position.col(Eigen::Index(i)) = part.position.col(copies[i].first);
    }
    result.mesh.triangle.resize(3, part.triangles());
    for (int c = 0; c < 3 * part.triangles(); ++c)
        result.mesh.triangle(c % 3, c / 3) = number[size_t(fan.root(c))];
    result.seam = rows_of(graph, std::move(cut));
    return result;
}

/// One cut after another.
CutPart followed_by(const CutPart& first, CutPart second)
{
    for (int& v : second.source)
        v = first.source[size_t(v)];
    for (std::vector<int>& row : second.seam)
        for (int& v : row)
            v = first.source[size_t(v)];
    second.seam.insert(second.seam.begin(), first.seam.begin(), first.seam.end());
    second.length += first.length;
    second.why = first.why.empty() ? second.why : first.why + "; " + second.why;
    return second;
}

void mark_path(const EdgeGraph& graph, const EdgePaths& paths, int v, std::vector<char>& cut)
{
    for (int e = paths.edge[size_t(v)]; e >= 0; e = paths.edge[size_t(v)]) {
        cut[size_t(e)] = 1;
        v = graph.edge[size_t(e)].other(v);
    }
}

CutPart cut_handles(const TriMesh& part, int genus)
{
    const EdgeGraph graph = edge_graph(part);
    std::vector<char> cut(graph.edge.size(), 0);
    for (const int e : handle_cut(graph, boundary_loops(part), part.triangles(), genus))
        cut[size_t(e)] = 1;
    CutPart result = cut_edges(part, graph, std::move(cut));
    result.why =
        fmt::format("the shortest found through {}", genus == 1 ? "its handle" : fmt::format("its {} handles", genus));
    return result;
}

CutPart cut_closed(const TriMesh& part)
{
    const EdgeGraph graph = edge_graph(part);
    const auto farthest = [](const EdgePaths& paths) {
        return int(std::max_element(paths.distance.begin(), paths.distance.end()) - paths.distance.begin());
    };
    const int from = farthest(shortest_paths(graph, {0}, RimCost::as_long_as_it_is));
    const EdgePaths paths = shortest_paths(graph, {from}, RimCost::as_long_as_it_is);
    std::vector<char> cut(graph.edge.size(), 0);
    mark_path(graph, paths, farthest(paths), cut);
    if (std::count(cut.begin(), cut.end(), char(1)) == 1) // a single edge cannot be opened
        for (int i = graph.first[size_t(from)]; i < graph.first[size_t(from) + 1]; ++i)
            if (!std::exchange(cut[size_t(graph.at[size_t(i)])], char(1)))
                break;
    CutPart result = cut_edges(part, graph, std::move(cut));
    result.why = "the shortest between two of its points that are farthest apart";
    return result;
}

/// The boundary of a part, its lengths and how it turns.
struct Rims {
    std::vector<std::vector<int>> loop;
    std::vector<double> length;  ///< mm; the longest comes first
    std::vector<double> turning; ///< radians
    double curvature = 0;        ///< radians, of all vertices inside without their signs: 0 where
                                 ///< the sheet is only bent
};

Rims rims_of(const TriMesh& part, std::vector<std::vector<int>> loops)
{
    Rims rims{std::move(loops), {}, {}, angle_defects(part).cwiseAbs().sum()};
    rims.turning = turnings(part, rims.loop);
    for (const std::vector<int>& loop : rims.loop) {
        double length = 0;
        for (size_t i = 0; i < loop.size(); ++i)
            length += (part.position.col(loop[(i + 1) % loop.size()]) - part.position.col(loop[i])).norm();
        rims.length.push_back(length);
    }
    return rims;
}

/// Cuts the tube that would suffer most, if there is one.
std::optional<CutPart> cut_tube(const TriMesh& part, const Rims& rims)
{
    // Logarithms of the scale. Rings at the limit came out of the solver with equivalent strains of
    // 0.8.
    constexpr double most_ring = std::numbers::ln2, least_gain = 0.5;
    constexpr double least_end = 0.25; // of the length of the loop looked at
    constexpr double window = -1.5 * std::numbers::pi;
    if (rims.loop.size() < 2)
        return std::nullopt;
    FrontMarch march(part);
    std::vector<char> ends(size_t(part.vertices()), 0), worst_ends;
    size_t worst = rims.loop.size();
    double ring = most_ring;
    // Sheet that is only bent unrolls between its windows; the front is not exact among the needles
    // of bends.
    constexpr double only_bent = 1; // radians; of a dome 2 pi
    for (const bool windows_count : {false, true}) {
        if (windows_count && rims.curvature < only_bent)
            break;
        const auto end = [&](size_t k) { return windows_count || rims.turning[k] > window; };
        for (size_t j = 0; j < rims.loop.size(); ++j) {
            bool any = false;
            for (size_t k = 0; k < rims.loop.size(); ++k) {
                const bool counts = k != j && end(k) && rims.length[k] >= least_end * rims.length[j];
                any = any || counts;
                for (const int v : rims.loop[k])
                    ends[size_t(v)] = counts;
            }
            if (!any || !end(j))
                continue;
            const RingStrain strain = ring_strain(march, rims.loop[j], ends);
            if (strain.ring > ring && strain.fan < least_gain * strain.ring) {
                ring = strain.ring;
                worst = j;
                worst_ends = ends;
            }
        }
        if (worst < rims.loop.size())
            break;
    }
    if (worst == rims.loop.size())
        return std::nullopt;
    const EdgeGraph graph = edge_graph(part);
    const EdgePaths paths = shortest_paths(graph, rims.loop[worst], RimCost::none, worst_ends);
    std::vector<char> cut(graph.edge.size(), 0);
    mark_path(graph, paths, paths.reached, cut);
    CutPart result = cut_edges(part, graph, std::move(cut));
    result.why =
        fmt::format("the shortest from one end of the tube to the other, whose ends as the edges of a flat ring "
                    "would be scaled apart by a factor of {:.3g}",
                    std::exp(ring));
    return result;
}

/// Cuts from the longest rim to the farthest point if that rim is a narrow mouth.
std::optional<CutPart> cut_bottle(const TriMesh& part, const Rims& rims)
{
    constexpr double narrow = 0.25;
    // The girth of a body is about the root of pi times its area; a mouth far below that is worth a
    // look.
    if (rims.loop.empty() || rims.length[0] * rims.length[0] > area(part))
        return std::nullopt;
    FrontMarch march(part);
    const RingStrain around = ring_strain(march, rims.loop[0], std::vector<char>(size_t(part.vertices()), 0));
    if (rims.length[0] >= narrow * around.widest)
        return std::nullopt;
    const EdgeGraph graph = edge_graph(part);
    const EdgePaths paths = shortest_paths(graph, rims.loop[0], RimCost::none);
    const int farthest = int(std::max_element(paths.distance.begin(), paths.distance.end()) - paths.distance.begin());
    std::vector<char> cut(graph.edge.size(), 0);
    mark_path(graph, paths, farthest, cut);
    CutPart result = cut_edges(part, graph, std::move(cut));
    result.why =
        fmt::format("the shortest from its mouth of {:.4g} mm, too narrow for the {:.4g} mm around its widest place, "
                    "to its farthest point",
                    rims.length[0], around.widest);
    return result;
}

CutPart cut_given(const TriMesh& part, const std::vector<std::vector<int>>& path)
{
    const EdgeGraph graph = edge_graph(part);
    std::vector<char> cut(graph.edge.size(), 0);
    for (const std::vector<int>& row : path) {
        if (row.size() < 2)
            throw InputError("a path of the seam has fewer than two vertices; give where it begins and where it ends");
        for (const int v : row)
            if (v < 0 || v >= part.vertices())
                throw InputError(fmt::format("the seam names vertex {}, which the part does not have", v));
        for (size_t i = 1; i < row.size(); ++i) {
            std::vector<char> target(size_t(part.vertices()), 0);
            target[size_t(row[i])] = 1;
            const EdgePaths paths = shortest_paths(graph, {row[i - 1]}, RimCost::as_long_as_it_is, target);
            if (paths.reached < 0)
                throw InputError(
                    fmt::format("no path along edges leads from vertex {} of the seam to vertex {}; leave out the "
                                "repeated one, or choose vertices of one piece",
                                row[i - 1], row[i]));
            mark_path(graph, paths, row[i], cut);
        }
    }
    CutPart result = cut_edges(part, graph, std::move(cut));
    const SurfaceType left = surface_type(result.mesh);
    if (left.components > 1)
        throw InputError(fmt::format("the seam cuts the part into {} pieces; leave one of its paths open somewhere",
                                     left.components));
    if (left.loops == 0)
        throw InputError("the seam opens nothing: the part is still closed");
    if (left.genus > 0)
        throw InputError(
            fmt::format("with this seam the part still has {}: a cut through each and around it is needed; "
                        "add paths, or leave the seam to the program",
                        left.genus == 1 ? "a handle" : fmt::format("{} handles", left.genus)));
    result.why = "as it was given";
    const Rims rims = rims_of(result.mesh, boundary_loops(result.mesh));
    if (cut_bottle(result.mesh, rims))
        result.why +=
            "; what is left is still a bottle, which would have been cut open from its mouth to its farthest point";
    else if (cut_tube(result.mesh, rims))
        result.why += "; what is left is still a tube, which would have been cut open from end to end";
    return result;
}

SurfaceType type_of(const TriMesh& part, const std::vector<std::vector<int>>& loops)
{
    DisjointSets pieces(size_t(part.vertices()));
    std::vector<char> used(size_t(part.vertices()), 0);
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            used[size_t(part.triangle(k, f))] = 1;
            pieces.join(part.triangle(k, f), part.triangle((k + 1) % 3, f));
        }
    SurfaceType type;
    int vertices = 0, sides = 3 * part.triangles(); // twice the edges
    for (int v = 0; v < part.vertices(); ++v) {
        vertices += used[size_t(v)];
        type.components += used[size_t(v)] && pieces.root(v) == v;
    }
    for (const std::vector<int>& loop : loops)
        sides += int(loop.size());
    type.loops = int(loops.size());
    // 2 components - 2 genus - loops
    const int characteristic = vertices - sides / 2 + part.triangles();
    type.genus = (2 * type.components - type.loops - characteristic) / 2;
    return type;
}

} // namespace

SurfaceType surface_type(const TriMesh& part) { return type_of(part, boundary_loops(part)); }

CutPart cut_along(const TriMesh& part, const std::vector<std::array<int, 2>>& edges)
{
    const EdgeGraph graph = edge_graph(part);
    std::vector<char> cut(graph.edge.size(), 0);
    for (const auto& [a, b] : edges) {
        const int e = a >= 0 && b >= 0 && a < part.vertices() && b < part.vertices() ? graph.find(a, b) : -1;
        if (e < 0)
            throw InputError(fmt::format("the part has no edge between the vertices {} and {}", a, b));
        cut[size_t(e)] = 1;
    }
    return cut_edges(part, graph, std::move(cut));
}

CutPart cut_open(const TriMesh& part, const SeamOptions& options)
{
    if (options.mode == SeamOptions::Mode::none)
        return uncut(part);
    if (options.mode == SeamOptions::Mode::given)
        return cut_given(part, options.path);
    auto loops = boundary_loops(part);
    const SurfaceType type = type_of(part, loops);
    CutPart result = type.genus > 0 ? cut_handles(part, type.genus) : type.loops == 0 ? cut_closed(part) : uncut(part);
    for (;;) {
        const Rims rims = rims_of(result.mesh, result.seam.empty() ? std::move(loops) : boundary_loops(result.mesh));
        std::optional<CutPart> next = cut_bottle(result.mesh, rims);
        if (!next)
            next = cut_tube(result.mesh, rims);
        if (!next)
            return result;
        result = followed_by(result, std::move(*next));
    }
}

bool has_both_skins(const TriMesh& part)
{
    double volume = 0; // by the divergence theorem; the apex of the pyramids does not matter
    const Eigen::Vector3d apex = part.position.col(0);
    for (int f = 0; f < part.triangles(); ++f) {
        const auto t = part.triangle.col(f);
        volume += (part.position.col(t[0]) - apex)
                      .dot((part.position.col(t[1]) - apex).cross(part.position.col(t[2]) - apex)) /
                  6;
    }
    const double whole = area(part);
    constexpr double thin = 1.0 / 40;
    return 2 * std::abs(volume) / whole < thin * std::sqrt(whole / 2);
}

} // namespace spia
