#include "engine/remesh/edge_sizes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "engine/core/small_dense.h"
#include "engine/mesh/curvature.h"
#include "engine/mesh/edge_graph.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// The chord of a circle with this sagitta.
double chord(double curvature, double sagitta)
{
    return curvature > 0 ? std::sqrt(8 * sagitta / curvature) : std::numeric_limits<double>::infinity();
}

/// Largest principal curvature at each vertex, 1/mm.
Eigen::VectorXd curvature(const TriMesh& mesh, const EdgeGraph& graph, const std::vector<char>& kept, double reach)
{
    const Eigen::Matrix3Xd normal = area_vectors(mesh);
    std::vector<Eigen::Matrix3d> bent(size_t(mesh.vertices()), Eigen::Matrix3d::Zero()); // mm
    Eigen::VectorXd area = Eigen::VectorXd::Zero(mesh.vertices());
    for (int f = 0; f < mesh.triangles(); ++f)
        for (const int v : mesh.triangle.col(f))
            area[v] += normal.col(f).norm() / 3;
    for (size_t e = 0; e < graph.edge.size(); ++e) {
        const EdgeGraph::Edge& edge = graph.edge[e];
        if (kept[e])
            continue;
        const Eigen::Vector3d a = normal.col(edge.face), b = normal.col(edge.twin);
        const Eigen::Vector3d along = mesh.position.col(edge.high) - mesh.position.col(edge.low);
        const double length = along.norm();
        double angle = std::atan2(a.cross(b).norm(), a.dot(b));
        if (!(length > 0))
            continue;
        if (a.cross(b).dot(along) < 0)
            angle = -angle;
        const Eigen::Matrix3d part = angle / length / 2 * along * along.transpose();
        bent[size_t(edge.low)] += part;
        bent[size_t(edge.high)] += part;
    }
    // Sums of both over a neighbourhood: a mean that is not led astray by a sliver.
    constexpr int most_rounds = 1;
    for (int round = 0; round < most_rounds; ++round) {
        const auto bent_before = bent;
        const Eigen::VectorXd area_before = area;
        for (const EdgeGraph::Edge& edge : graph.edge) {
            if (edge.length > reach)
                continue;
            for (const auto& [to, from] : {std::pair(edge.low, edge.high), std::pair(edge.high, edge.low)}) {
                bent[size_t(to)] += bent_before[size_t(from)];
                area[to] += area_before[from];
            }
        }
    }
    Eigen::VectorXd result = Eigen::VectorXd::Zero(mesh.vertices());
    for (int v = 0; v < mesh.vertices(); ++v)
        if (area[v] > 0)
            result[v] = eigen_pairs(bent[size_t(v)] / area[v]).value.cwiseAbs().maxCoeff();
    return result;
}

/// Where the given triangles are coarse, an edge across the ridge between two of them cuts it off
/// by a quarter of its length times the angle. Where they are finer than that length their ridges
/// together are a curvature, which the vertices know; of long ones it goes on between these.
void limit_by_ridges(const TriMesh& mesh, const EdgeGraph& graph, const std::vector<char>& kept, double sagitta,
                     EdgeSizes& sizes)
{
    sizes.along_edge.setConstant(Eigen::Index(graph.edge.size()), std::numeric_limits<double>::infinity());
    const Eigen::Matrix3Xd normal = area_vectors(mesh);
    for (size_t e = 0; e < graph.edge.size(); ++e) {
        const EdgeGraph::Edge& edge = graph.edge[e];
        if (kept[e] == 1 || !(edge.length > 0))
            continue;
        const Eigen::Vector3d a = normal.col(edge.face), b = normal.col(edge.twin);
        const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
        const double width = 2 * std::min(a.norm(), b.norm()) / edge.length;
        constexpr double longest_in_strip = 1.5; // of its width: triangles from one ridge to the
                                                 // next have good angles
        const double most = kept[e] == 2                  ? longest_in_strip * width
                            : 4 * sagitta < width * angle ? 4 * sagitta / angle
                                                          : std::numeric_limits<double>::infinity();
        for (const int v : {edge.low, edge.high})
            sizes.at_vertex[v] = std::min(sizes.at_vertex[v], most);
        const double mean_width = (a.norm() + b.norm()) / edge.length;
        sizes.along_edge[Eigen::Index(e)] = std::min(most, chord(angle / mean_width, sagitta));
    }
}

/// Calls visit(vertex, edge from the one before, edge to the next) at vertices inside of lines.
template <class Visit> void for_each_inner(const TriMesh& mesh, const std::vector<int>& line, const Visit& visit)
{
    const auto way = [&](int a, int b) -> Eigen::Vector3d { return mesh.position.col(b) - mesh.position.col(a); };
    const bool closed = line.front() == line.back();
    for (size_t i = 0; i < line.size(); ++i) {
        const bool inner = i > 0 && i + 1 < line.size();
        if (inner || closed)
            visit(line[i], way(inner ? line[i - 1] : line[line.size() - 2], line[i]),
                  way(line[i], inner ? line[i + 1] : line[1]));
    }
}

double turn(const Eigen::Vector3d& in, const Eigen::Vector3d& out)
{
    return std::atan2(in.cross(out).norm(), in.dot(out));
}

/// Lines that are short, or turn within a short way.
void limit_by_lines(const TriMesh& mesh, const KeptLines& lines, const SizeLimits& limits, Eigen::VectorXd& size)
{
    const std::vector<char> within = bends_within(mesh, lines);
    for (const std::vector<int>& line : lines.line) {
        double length = 0;
        for (size_t i = 0; i + 1 < line.size(); ++i)
            length += (mesh.position.col(line[i + 1]) - mesh.position.col(line[i])).norm();
        const bool closed = line.front() == line.back();
        const double most = closed ? length / 6 : length; // a hole stays round enough to be one
        for (const int v : line)
            size[v] = std::min(size[v], most);
        for_each_inner(mesh, line, [&](int v, const Eigen::Vector3d& in, const Eigen::Vector3d& out) {
            const double curvature = 2 * turn(in, out) / (in.norm() + out.norm());
            double most_here = chord(curvature, limits.sagitta);
            if (within[size_t(v)])
                most_here = std::max(chord(curvature, border_share * limits.sagitta), // no finer than it is known
                                     std::min(most_here, std::max(in.norm(), out.norm())));
            size[v] = std::min(size[v], most_here);
        });
    }
}

} // namespace

std::vector<char> bends_within(const TriMesh& mesh, const KeptLines& lines)
{
    const EdgeGraph graph = edge_graph(mesh);
    const Eigen::VectorXd angle = angle_sums(mesh);
    std::vector<char> result(size_t(mesh.vertices()), 0);
    constexpr double mostly = 0.5; // of all that it bends by
    for (const std::vector<int>& line : lines.line)
        for_each_inner(mesh, line, [&](int v, const Eigen::Vector3d& in, const Eigen::Vector3d& out) {
            result[size_t(v)] =
                graph.on_rim[size_t(v)] && std::abs(std::numbers::pi - angle[v]) > mostly * turn(in, out);
        });
    return result;
}

void limit_growth(const TriMesh& mesh, double growth, Eigen::VectorXd& size)
{
    const EdgeGraph graph = edge_graph(mesh);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (int v = 0; v < mesh.vertices(); ++v)
        queue.emplace(size[v], v);
    while (!queue.empty()) {
        const auto [here, v] = queue.top();
        queue.pop();
        if (here > size[v])
            continue;
        for (int i = graph.first[size_t(v)]; i < graph.first[size_t(v) + 1]; ++i) {
            const EdgeGraph::Edge& edge = graph.edge[size_t(graph.at[size_t(i)])];
            const int other = edge.other(v);
            if (const double most = here + growth * edge.length; most < size[other]) {
                size[other] = most;
                queue.emplace(most, other);
            }
        }
    }
}

EdgeSizes edge_sizes(const TriMesh& mesh, const KeptLines& lines, const SizeLimits& limits, const EdgeSizes& also)
{
    const EdgeGraph graph = edge_graph(mesh);
    const Eigen::VectorXd bent = curvature(mesh, graph, lines.edge, limits.most);
    EdgeSizes result{Eigen::VectorXd(mesh.vertices()), {}, also.elsewhere, limits.most, limits.growth};
    Eigen::VectorXd& size = result.at_vertex;
    for (int v = 0; v < mesh.vertices(); ++v)
        size[v] = std::min(limits.most, chord(bent[v], limits.sagitta));
    limit_by_ridges(mesh, graph, lines.edge, limits.sagitta, result);
    limit_by_lines(mesh, lines, limits, size);
    if (also.at_vertex.size() > 0)
        size = size.cwiseMin(also.at_vertex);
    size = size.cwiseMax(limits.least);
    result.along_edge = result.along_edge.cwiseMax(limits.least);
    for (EdgeSizes::Place& place : result.elsewhere)
        place.size = std::max(place.size, limits.least);
    limit_growth(mesh, limits.growth, size);
    return result;
}

} // namespace spia
