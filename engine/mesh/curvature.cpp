#include "engine/mesh/curvature.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "engine/mesh/edge_graph.h"

namespace spia {

Eigen::VectorXd angle_sums(const TriMesh& mesh)
{
    Eigen::VectorXd angle = Eigen::VectorXd::Zero(mesh.vertices());
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto corner = [&](int i) { return mesh.position.col(mesh.triangle((k + i) % 3, f)); };
            const Eigen::Vector3d a = corner(1) - corner(0), b = corner(2) - corner(0);
            angle[mesh.triangle(k, f)] += std::atan2(a.cross(b).norm(), a.dot(b));
        }
    return angle;
}

Eigen::VectorXd angle_defects(const TriMesh& mesh)
{
    const EdgeGraph graph = edge_graph(mesh);
    const Eigen::VectorXd angle = angle_sums(mesh);
    Eigen::VectorXd defect = 2 * std::numbers::pi - angle.array();
    for (int v = 0; v < mesh.vertices(); ++v)
        if (graph.on_rim[size_t(v)] || angle[v] == 0) // none of a vertex without triangles
            defect[v] = 0;
    return defect;
}

std::vector<double> turnings(const TriMesh& mesh, const std::vector<std::vector<int>>& loops)
{
    const Eigen::VectorXd angle = angle_sums(mesh);
    std::vector<double> result;
    for (const std::vector<int>& loop : loops) {
        double turning = 0;
        for (const int v : loop)
            turning += std::numbers::pi - angle[v];
        result.push_back(turning);
    }
    return result;
}

} // namespace spia
