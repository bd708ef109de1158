#include "engine/mesh/solid/fit/plane_regions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace spia {
namespace {

/// Gives what can be reached from a triangle in its plane the number of that plane.
void spread(const TriMesh& solid, const Eigen::Matrix3Xd& normal, const Eigen::Matrix3Xi& neighbour, double within,
            int seed, int plane, std::vector<int>& of)
{
    constexpr double facing = 0.9; // 25 degrees: slivers have hardly a direction
    const Eigen::Vector3d origin = solid.position.col(solid.triangle(0, seed)),
                          direction = normal.col(seed).normalized();
    const auto in_it = [&](int f) {
        const Eigen::Vector3d n = normal.col(f);
        for (const int v : solid.triangle.col(f))
            if (std::abs((solid.position.col(v) - origin).dot(direction)) > within)
                return false;
        return n.dot(direction) > facing * n.norm() || altitude(solid, f, n) < within;
    };
    std::vector<int> reached{seed};
    of[size_t(seed)] = plane;
    while (!reached.empty()) {
        const int f = reached.back();
        reached.pop_back();
        for (const int next : neighbour.col(f))
            if (next >= 0 && of[size_t(next)] < 0 && in_it(next)) {
                of[size_t(next)] = plane;
                reached.push_back(next);
            }
    }
}

/// Closed rows of edges; those that touch others at a vertex are left out.
std::vector<std::vector<FaceEdge>> loops_of(const TriMesh& solid, const std::vector<FaceEdge>& edges)
{
    const auto end_of = [&](const FaceEdge& at) { return solid.triangle((at.k + 1) % 3, at.face); };
    std::map<int, const FaceEdge*> from;
    std::map<int, int> uses;
    for (const FaceEdge& at : edges) {
        const int v = solid.triangle(at.k, at.face);
        from[v] = &at;
        ++uses[v];
    }
    std::vector<std::vector<FaceEdge>> loops;
    while (!from.empty()) {
        const int start = from.begin()->first;
        std::vector<FaceEdge> loop;
        bool alone = true;
        for (auto at = from.find(start); at != from.end(); at = from.find(end_of(loop.back()))) {
            alone &= uses[at->first] == 1 && at->second->next >= 0;
            loop.push_back(*at->second);
            from.erase(at);
        }
        if (alone && end_of(loop.back()) == start)
            loops.push_back(std::move(loop));
    }
    return loops;
}

} // namespace

PlaneRegions plane_regions(const TriMesh& solid, const Eigen::Matrix3Xd& normal, const Eigen::Matrix3Xi& neighbour,
                           double within)
{
    const Eigen::VectorXd size = normal.colwise().norm();
    std::vector<int> order(size_t(solid.triangles()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return size[a] > size[b]; });
    PlaneRegions planes;
    planes.of.assign(order.size(), -1);
    std::vector<int> seeds;
    for (const int seed : order)
        if (planes.of[size_t(seed)] < 0) {
            spread(solid, normal, neighbour, within, seed, int(seeds.size()), planes.of);
            seeds.push_back(seed);
        }
    planes.direction = normal(Eigen::all, seeds).colwise().normalized();
    planes.level.resize(planes.direction.cols());
    for (size_t p = 0; p < seeds.size(); ++p)
        planes.level[Eigen::Index(p)] =
            solid.position.col(solid.triangle(0, seeds[p])).dot(planes.direction.col(Eigen::Index(p)));
    return planes;
}

std::vector<std::vector<std::vector<FaceEdge>>> borders_of(const PlaneRegions& planes, const TriMesh& solid,
                                                           const Eigen::Matrix3Xi& neighbour)
{
    std::vector<std::vector<FaceEdge>> border(size_t(planes.direction.cols()));
    for (int f = 0; f < solid.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            if (const int next = neighbour(k, f); next < 0 || planes.of[size_t(next)] != planes.of[size_t(f)])
                border[size_t(planes.of[size_t(f)])].push_back({f, k, next});
    std::vector<std::vector<std::vector<FaceEdge>>> loops;
    for (const std::vector<FaceEdge>& edges : border)
        loops.push_back(loops_of(solid, edges));
    return loops;
}

double altitude(const TriMesh& mesh, int face, const Eigen::Vector3d& normal)
{
    double longest = 0;
    for (int k = 0; k < 3; ++k)
        longest = std::max(
            longest,
            (mesh.position.col(mesh.triangle((k + 1) % 3, face)) - mesh.position.col(mesh.triangle(k, face))).norm());
    return 2 * normal.norm() / longest;
}

} // namespace spia
