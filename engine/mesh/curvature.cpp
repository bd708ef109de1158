#include "engine/mesh/curvature.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "engine/mesh/edge_graph.h"

namespace spia {

Eigen::VectorXd angle_defects(const TriMesh& mesh)
{
    const EdgeGraph graph = edge_graph(mesh);
    Eigen::VectorXd angle = Eigen::VectorXd::Zero(mesh.vertices());
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto corner = [&](int i) { return mesh.position.col(mesh.triangle((k + i) % 3, f)); };
            const Eigen::Vector3d a = corner(1) - corner(0), b = corner(2) - corner(0);
            angle[mesh.triangle(k, f)] += std::atan2(a.cross(b).norm(), a.dot(b));
        }
    Eigen::VectorXd defect = 2 * std::numbers::pi - angle.array();
    for (int v = 0; v < mesh.vertices(); ++v)
        if (graph.on_rim[size_t(v)] || angle[v] == 0) // none of a vertex without triangles
            defect[v] = 0;
    return defect;
}

} // namespace spia
