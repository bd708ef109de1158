#include "engine/mesh/cut/corner_seam.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/mesh/curvature.h"
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/edge_graph.h"

namespace spia {

std::optional<CornerSeam> corner_seam(const TriMesh& part)
{
    constexpr double corner = 0.1; // radians; a wall joined at 6 degrees can as well be drawn
    constexpr double unrolls =
        0.02; // radians, all together: bent parts measured have 0 to rounding, drawn ones 0.9 and
              // more
    constexpr size_t most = 64;
    const Eigen::VectorXd defect = angle_defects(part);
    CornerSeam seam;
    for (int v = 0; v < part.vertices(); ++v)
        if (std::abs(defect[v]) > corner) {
            seam.corner.push_back(v);
            seam.defect = std::max(seam.defect, std::abs(defect[v]));
        }
    if (seam.corner.empty() || seam.corner.size() > most)
        return std::nullopt;
    const EdgeGraph graph = edge_graph(part);
    std::vector<int> rim;
    for (int v = 0; v < part.vertices(); ++v)
        if (graph.on_rim[size_t(v)])
            rim.push_back(v);
    if (rim.empty())
        return std::nullopt;
    const EdgePaths ways = shortest_paths(graph, rim, RimCost::as_long_as_it_is);
    std::set<std::array<int, 2>> edges; // ways may run together
    for (const int v : seam.corner) {
        std::vector<int> path = path_to(graph, ways, v);
        std::reverse(path.begin(), path.end());
        for (size_t i = 0; i + 1 < path.size(); ++i)
            if (edges.insert({std::min(path[i], path[i + 1]), std::max(path[i], path[i + 1])}).second)
                seam.length += (part.position.col(path[i + 1]) - part.position.col(path[i])).norm();
        seam.path.push_back(std::move(path));
    }
    const CutPart cut = cut_along(part, std::vector(edges.begin(), edges.end()));
    if (!surface_type(cut.mesh).sheet() || angle_defects(cut.mesh).cwiseAbs().sum() > unrolls)
        return std::nullopt;
    return seam;
}

} // namespace spia
