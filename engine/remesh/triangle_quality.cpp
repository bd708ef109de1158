#include "engine/remesh/triangle_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/mesh/edge_graph.h"

namespace spia {

double least_angle(const Eigen::Matrix3d& triangle)
{
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d a = triangle.col((k + 1) % 3) - triangle.col(k),
                              b = triangle.col((k + 2) % 3) - triangle.col(k);
        least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
    return least;
}

double edge_ratio(const Eigen::Matrix3d& triangle)
{
    double shortest = std::numeric_limits<double>::infinity(), longest = 0;
    for (int k = 0; k < 3; ++k) {
        const double length = (triangle.col((k + 1) % 3) - triangle.col(k)).norm();
        shortest = std::min(shortest, length);
        longest = std::max(longest, length);
    }
    return longest / shortest;
}

TriangleQuality triangle_quality(const TriMesh& mesh)
{
    TriangleQuality result;
    result.triangles = mesh.triangles();
    if (mesh.triangles() == 0)
        return result;
    std::vector<double> angle;
    result.least_angle = std::numeric_limits<double>::infinity();
    for (int f = 0; f < mesh.triangles(); ++f) {
        const Eigen::Matrix3d triangle = mesh.position(Eigen::all, mesh.triangle.col(f));
        angle.push_back(least_angle(triangle));
        if (angle.back() < result.least_angle) {
            result.least_angle = angle.back();
            result.face = f;
        }
        result.edge_ratio = std::max(result.edge_ratio, edge_ratio(triangle));
    }
    const auto at_1_percent = angle.begin() + long(angle.size() / 100);
    std::nth_element(angle.begin(), at_1_percent, angle.end());
    result.least_angle_of_99 = *at_1_percent;
    std::vector<double> length;
    for (const EdgeGraph::Edge& edge : edge_graph(mesh).edge)
        length.push_back(edge.length);
    const auto middle = length.begin() + long(length.size() / 2);
    std::nth_element(length.begin(), middle, length.end());
    result.median_edge = *middle;
    return result;
}

double total_curvature(const TriMesh& mesh)
{
    const EdgeGraph graph = edge_graph(mesh);
    Eigen::VectorXd angle = Eigen::VectorXd::Zero(mesh.vertices());
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto corner = [&](int i) { return mesh.position.col(mesh.triangle((k + i) % 3, f)); };
            const Eigen::Vector3d a = corner(1) - corner(0), b = corner(2) - corner(0);
            angle[mesh.triangle(k, f)] += std::atan2(a.cross(b).norm(), a.dot(b));
        }
    Eigen::VectorXd curvature = (angle.array() - 2 * std::numbers::pi).abs();
    for (int v = 0; v < mesh.vertices(); ++v)
        if (graph.on_rim[size_t(v)] || angle[v] == 0) // none of a vertex without triangles
            curvature[v] = 0;
    return curvature.sum();
}

} // namespace spia
