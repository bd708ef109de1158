#include "app/viewer/render/coarse_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace spia::viewer {
namespace {

double area_of(const SceneMesh& mesh)
{
    double twice = 0;
    for (Eigen::Index f = 0; f < mesh.triangle.cols(); ++f) {
        const Eigen::Vector3f a = mesh.position.col(mesh.triangle(0, f));
        twice += double(
            (mesh.position.col(mesh.triangle(1, f)) - a).cross(mesh.position.col(mesh.triangle(2, f)) - a).norm());
    }
    return twice / 2;
}

/// Of every vertex the one that stands for its cube: the nearest to the middle of those in it.
std::vector<uint32_t> stand_ins(const SceneMesh& mesh, double side)
{
    const Eigen::Index vertices = mesh.position.cols();
    const Eigen::Vector3f corner = mesh.position.rowwise().minCoeff();
    struct Cube {
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        float nearest = std::numeric_limits<float>::infinity();
        uint32_t count = 0, vertex = 0;
    };
    std::vector<Cube> cubes;
    std::vector<uint32_t> cube_of(static_cast<size_t>(vertices));
    std::unordered_map<uint64_t, uint32_t> number;
    number.reserve(size_t(vertices) / 4);
    for (Eigen::Index v = 0; v < vertices; ++v) {
        constexpr uint64_t most = (1u << 21) - 1; // three of them in 64 bits
        uint64_t key = 0;
        for (int k = 0; k < 3; ++k)
            key = key << 21 | std::min(most, uint64_t(double(mesh.position(k, v) - corner[k]) / side));
        const auto [at, fresh] = number.try_emplace(key, uint32_t(cubes.size()));
        if (fresh)
            cubes.emplace_back();
        Cube& cube = cubes[at->second];
        cube.sum += mesh.position.col(v);
        ++cube.count;
        cube_of[size_t(v)] = at->second;
    }
    for (Eigen::Index v = 0; v < vertices; ++v) {
        Cube& cube = cubes[cube_of[size_t(v)]];
        const float away = (mesh.position.col(v) - cube.sum / float(cube.count)).squaredNorm();
        if (away < cube.nearest) {
            cube.nearest = away;
            cube.vertex = uint32_t(v);
        }
    }
    std::vector<uint32_t> result(static_cast<size_t>(vertices));
    for (size_t v = 0; v < result.size(); ++v)
        result[v] = cubes[cube_of[v]].vertex;
    return result;
}

} // namespace

CoarseMesh coarse_mesh(const SceneMesh& mesh, int about)
{
    CoarseMesh result;
    const double area = area_of(mesh);
    if (!(area > 0) || about < 1)
        return result;
    // A sheet meets about 1.5 cubes per square of their side, and has two triangles per cube.
    const double side = std::sqrt(3 * area / about);
    const std::vector<uint32_t> stands_for = stand_ins(mesh, side);
    std::vector<uint32_t> corners;
    for (Eigen::Index f = 0; f < mesh.triangle.cols(); ++f) {
        const uint32_t a = stands_for[mesh.triangle(0, f)], b = stands_for[mesh.triangle(1, f)],
                       c = stands_for[mesh.triangle(2, f)];
        if (a == b || b == c || c == a)
            continue;
        corners.insert(corners.end(), {a, b, c});
        result.face.push_back(uint32_t(f));
    }
    result.triangle =
        Eigen::Map<Eigen::Matrix<uint32_t, 3, Eigen::Dynamic>>(corners.data(), 3, Eigen::Index(result.face.size()));
    return result;
}

} // namespace spia::viewer
