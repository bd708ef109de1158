#include "engine/nurbs/mesh_samples.h"

#include <algorithm>
#include <tuple>

#include "engine/mesh/topology.h"

namespace spia {

MeshSamples sample_mesh(const TriMesh& mesh, int part_faces)
{
    struct EdgeOfFace {
        int a, b, face; ///< a < b
    };
    std::vector<EdgeOfFace> edges;
    edges.reserve(size_t(part_faces) * 3);
    for (int f = 0; f < part_faces; ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.triangle(k, f), b = mesh.triangle((k + 1) % 3, f);
            edges.push_back({std::min(a, b), std::max(a, b), f});
        }
    std::sort(edges.begin(), edges.end(), [](const EdgeOfFace& x, const EdgeOfFace& y) {
        return std::tie(x.a, x.b, x.face) < std::tie(y.a, y.b, y.face);
    });

    std::vector<Eigen::Vector3d> position;
    std::vector<double> weight(size_t(mesh.vertices()), 0);
    std::vector<char> counts(size_t(mesh.vertices()), 0);
    for (int v = 0; v < mesh.vertices(); ++v)
        position.push_back(mesh.position.col(v));
    const Eigen::VectorXd area = area_vectors(mesh).colwise().norm();
    for (int f = 0; f < part_faces; ++f) {
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        for (int v : mesh.triangle.col(f)) {
            weight[size_t(v)] += area[f] / 20;
            counts[size_t(v)] = 1;
            middle += mesh.position.col(v) / 3;
        }
        position.push_back(middle);
        weight.push_back(area[f] * 9 / 20);
    }
    for (size_t e = 0; e < edges.size(); ++e) {
        if (e == 0 || edges[e].a != edges[e - 1].a || edges[e].b != edges[e - 1].b) {
            position.push_back((mesh.position.col(edges[e].a) + mesh.position.col(edges[e].b)) / 2);
            weight.push_back(0);
        }
        weight.back() += area[edges[e].face] * 2 / 15;
    }

    MeshSamples result{Eigen::Matrix3Xd(3, position.size()), std::move(weight), std::move(counts)};
    for (size_t i = 0; i < position.size(); ++i)
        result.position.col(Eigen::Index(i)) = position[i];
    result.counts.resize(position.size(), 1);
    return result;
}

} // namespace spia
