#include "engine/remesh/triangle_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/mesh/curvature.h"
#include "engine/mesh/edge_graph.h"

namespace spia {

double least_angle(const Eigen::Matrix3d& triangle)
{
    // The one opposite to the shortest edge: an arc tangent costs as much as all else here.
    const Eigen::Vector3d side[3] = {triangle.col(2) - triangle.col(1), triangle.col(0) - triangle.col(2),
                                     triangle.col(1) - triangle.col(0)};
    const double length[3] = {side[0].squaredNorm(), side[1].squaredNorm(), side[2].squaredNorm()};
    const int k = length[0] <= length[1] ? (length[0] <= length[2] ? 0 : 2) : (length[1] <= length[2] ? 1 : 2);
    const Eigen::Vector3d &a = side[(k + 1) % 3], &b = side[(k + 2) % 3];
    return std::atan2(a.cross(b).norm(), 0 - a.dot(b)); // not -0, whose angle is pi
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

double total_curvature(const TriMesh& mesh) { return angle_defects(mesh).cwiseAbs().sum(); }

} // namespace spia
