#include "engine/remesh/border_clearance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mesh/closest_point.h"
#include "engine/mesh/edge_graph.h"

namespace spia {
namespace {

/// An edge of the boundary and the way out of the sheet in the plane of its face.
struct BorderEdge {
    int low, high;
    Eigen::Vector3d middle, out;
};

std::vector<BorderEdge> border_edges(const TriMesh& mesh)
{
    std::vector<BorderEdge> result;
    for (const EdgeGraph::Edge& edge : edge_graph(mesh).edge) {
        if (!edge.boundary() || !(edge.length > 0))
            continue;
        const Eigen::Matrix3d corners = mesh.position(Eigen::all, mesh.triangle.col(edge.face));
        const Eigen::Vector3d a = mesh.position.col(edge.low), b = mesh.position.col(edge.high);
        Eigen::Vector3d out = (a + b) / 2 - corners.rowwise().mean();
        out -= out.dot(b - a) / (b - a).squaredNorm() * (b - a);
        if (out.norm() > 0)
            result.push_back({edge.low, edge.high, (a + b) / 2, out.normalized()});
    }
    return result;
}

} // namespace

Eigen::VectorXd border_clearance(const TriMesh& mesh, double reach, const Progress& progress)
{
    Eigen::VectorXd result = Eigen::VectorXd::Constant(mesh.vertices(), 2 * reach);
    const std::vector<BorderEdge> border = border_edges(mesh);
    if (border.empty())
        return result;
    TriMesh segments{mesh.position, Eigen::Matrix3Xi(3, border.size())};
    for (size_t i = 0; i < border.size(); ++i)
        segments.triangle.col(Eigen::Index(i)) << border[i].low, border[i].high, border[i].high;
    const ClosestPointSearch search(segments);
    std::vector<double> gap(border.size());
    constexpr int at_a_time = 4096, halvings = 12;
    for (int first = 0; first < int(border.size()); first += at_a_time) {
        progress.checkpoint(double(first) / double(border.size()), "measuring narrow gaps");
        parallel_for(std::min(at_a_time, int(border.size()) - first), [&](int k) {
            const BorderEdge& edge = border[size_t(first + k)];
            constexpr double own = 0.99; // nearer than that is another edge
            double way = reach;
            for (int i = 0; i < halvings && search.nearest(edge.middle + way * edge.out).distance < own * way; ++i)
                way /= 2;
            gap[size_t(first + k)] = 2 * way;
        });
    }
    for (size_t i = 0; i < border.size(); ++i)
        for (const int v : {border[i].low, border[i].high})
            result[v] = std::min(result[v], gap[i]);
    return result;
}

} // namespace spia
