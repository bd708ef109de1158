#include "engine/mesh/topology.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/core.h>
#include <utility>

#include "engine/core/error.h"
#include "engine/mesh/edge_uses.h"

namespace spia {

std::vector<std::vector<int>> boundary_loops(const TriMesh& mesh)
{
    const auto refuse = [&](int f) {
        const auto t = mesh.triangle.col(f);
        throw InputError(fmt::format(
            "face {} (vertices {}, {}, {}) shares an edge with two others, is turned against its neighbours or touches "
            "them in a vertex only; run the mesh doctor (`spia info`) and mend the mesh there",
            f, t[0], t[1], t[2]));
    };
    // A boundary edge is an edge of one face; the face runs along it with itself on the left.
    std::vector<int> next(size_t(mesh.vertices()), -1);
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        const EdgeUse& use = uses[begin];
        if (end - begin > 2 || (end - begin == 2 && use.forward == uses[begin + 1].forward))
            refuse(uses[end - 1].face);
        if (end - begin == 2)
            return;
        const int from = use.forward ? use.low : use.high, to = use.forward ? use.high : use.low;
        if (next[size_t(from)] >= 0)
            refuse(use.face);
        next[size_t(from)] = to;
    });
    std::vector<std::vector<int>> loops;
    for (int start = 0; start < mesh.vertices(); ++start) {
        std::vector<int> loop;
        for (int v = start; next[size_t(v)] >= 0;) { // each vertex is left once, so the way leads
                                                     // back to the start
            loop.push_back(v);
            v = std::exchange(next[size_t(v)], -1);
        }
        if (!loop.empty())
            loops.push_back(std::move(loop));
    }
    const auto length = [&](const std::vector<int>& loop) {
        double sum = 0;
        for (size_t i = 0; i < loop.size(); ++i)
            sum += (mesh.position.col(loop[(i + 1) % loop.size()]) - mesh.position.col(loop[i])).norm();
        return sum;
    };
    std::stable_sort(loops.begin(), loops.end(), [&](const auto& a, const auto& b) { return length(a) > length(b); });
    return loops;
}

Eigen::Matrix3Xd area_vectors(const TriMesh& mesh)
{
    Eigen::Matrix3Xd result(3, mesh.triangles());
    for (int f = 0; f < mesh.triangles(); ++f) {
        const Eigen::Vector3d a = mesh.position.col(mesh.triangle(0, f));
        const Eigen::Vector3d b = mesh.position.col(mesh.triangle(1, f));
        const Eigen::Vector3d c = mesh.position.col(mesh.triangle(2, f));
        result.col(f) = 0.5 * (b - a).cross(c - a);
    }
    return result;
}

Eigen::Matrix3Xd vertex_normals(const TriMesh& mesh)
{
    const Eigen::Matrix3Xd face = area_vectors(mesh);
    Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, mesh.vertices());
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            result.col(mesh.triangle(k, f)) += face.col(f);
    for (int v = 0; v < mesh.vertices(); ++v)
        result.col(v).normalize();
    return result;
}

double area(const TriMesh& mesh) { return area_vectors(mesh).colwise().norm().sum(); }

double bounding_diagonal(const TriMesh& mesh)
{
    if (mesh.vertices() == 0)
        return 0;
    return (mesh.position.rowwise().maxCoeff() - mesh.position.rowwise().minCoeff()).norm();
}

} // namespace spia
