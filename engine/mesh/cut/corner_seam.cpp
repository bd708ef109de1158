#include "engine/mesh/cut/corner_seam.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/mesh/curvature.h"
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/edge_graph.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

constexpr double corner = 0.5;   // radians; less is one of many along a crease, as where a collar
                                 // stands up from a plate, and so cut the sheet would overlap
constexpr double ring = 0.1;     // radians; a washer of 10 degrees of slope can as well be drawn
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

} // namespace

std::optional<CornerSeam> corner_seam(const TriMesh& part)
{
    constexpr size_t most = 64;
    const Eigen::VectorXd defect = angle_defects(part);
    const std::vector<std::vector<int>> loops = boundary_loops(part);
    if (loops.empty())
        return std::nullopt;
    CornerSeam seam;
    for (int v = 0; v < part.vertices(); ++v)
        if (std::abs(defect[v]) > corner) {
            seam.corner.push_back(v);
            seam.defect = std::max(seam.defect, std::abs(defect[v]));
        }
    const std::vector<std::vector<int>> opening = rings(part, loops);
    for (const double turning : turnings(part, opening))
        seam.defect = std::max(seam.defect, std::abs(turning + 2 * std::numbers::pi));
    if (seam.corner.size() + opening.size() == 0 || seam.corner.size() + opening.size() > most)
        return std::nullopt;
    const EdgeGraph graph = edge_graph(part);
    const EdgePaths ways = shortest_paths(graph, loops.front(), RimCost::as_long_as_it_is);
    for (const std::vector<int>& loop : opening)
        seam.opening.push_back(*std::ranges::min_element(loop, {}, [&](int v) { return ways.distance[size_t(v)]; }));
    std::set<std::array<int, 2>> edges; // ways may run together
    for (const std::vector<int>* from : {&seam.corner, &seam.opening})
        for (const int v : *from) {
            std::vector<int> path = path_to(graph, ways, v);
            std::reverse(path.begin(), path.end());
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

} // namespace spia
