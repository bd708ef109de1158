#include "engine/mesh/refilled_mark.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>

#include "engine/mesh/split_polygon.h"

namespace spia {
namespace {

/// The triangle that has the edge from a to b; -1: none.
int face_of_edge(const TriMesh& mesh, const std::vector<std::vector<int>>& around, int a, int b)
{
    for (const int f : around[size_t(a)])
        for (int k = 0; k < 3; ++k)
            if (mesh.triangle(k, f) == a && mesh.triangle((k + 1) % 3, f) == b)
                return f;
    return -1;
}

/// Of edges from vertex to vertex the loop that has them all; empty: there is none.
std::vector<int> one_loop(const std::map<int, int>& next)
{
    std::vector<int> loop;
    int v = next.empty() ? -1 : next.begin()->first;
    while (v >= 0 && loop.size() < next.size()) {
        loop.push_back(v);
        const auto found = next.find(v);
        v = found == next.end() ? -1 : found->second;
    }
    return loop.size() == next.size() && v == loop.front() ? loop : std::vector<int>();
}

Eigen::Vector3d newell(const TriMesh& mesh, const std::vector<int>& loop)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const Eigen::Vector3d from = mesh.position.col(loop.front());
    for (size_t i = 0; i < loop.size(); ++i)
        sum += (mesh.position.col(loop[i]) - from).cross(mesh.position.col(loop[(i + 1) % loop.size()]) - from);
    return sum;
}

} // namespace

std::optional<RefilledMark> refilled_mark(const TriMesh& solid, const Eigen::Matrix3Xd& normal,
                                          const std::vector<int>& faces, const std::vector<char>& mark,
                                          const std::vector<char>& skin, const std::vector<std::vector<int>>& around,
                                          double flat)
{
    constexpr double parallel = 0.9999; // 0.8 degrees: the skin beside it, on average
    std::map<int, int> next;
    RefilledMark result;
    std::vector<int> beside;
    for (const int f : faces)
        for (int k = 0; k < 3; ++k) {
            const int a = solid.triangle(k, f), b = solid.triangle((k + 1) % 3, f);
            const int g = face_of_edge(solid, around, b, a);
            if (g >= 0 && mark[size_t(g)])
                continue;
            if (g < 0 || !skin[size_t(g)] || !next.emplace(a, b).second)
                return std::nullopt;
            beside.push_back(g);
        }
    const std::vector<int> loop = one_loop(next);
    if (loop.size() < 3)
        return std::nullopt;
    const Eigen::Vector3d up = newell(solid, loop).normalized();
    const Eigen::Vector3d middle = solid.position(Eigen::all, loop).rowwise().mean();
    const auto off = [&](int v) { return std::abs(up.dot(solid.position.col(v) - middle)); };
    if (!std::all_of(loop.begin(), loop.end(), [&](int v) { return off(v) <= flat; }))
        return std::nullopt;
    double along = 0, whole = 0;
    for (const int g : beside) {
        along += up.dot(normal.col(g));
        whole += normal.col(g).norm();
    }
    if (!(std::abs(along) >= parallel * whole))
        return std::nullopt;
    std::vector<Eigen::Vector3d> corners;
    for (const int v : loop)
        corners.push_back(solid.position.col(v));
    for (const std::array<int, 3>& t : split_polygon(corners))
        result.triangle.push_back({loop[size_t(t[0])], loop[size_t(t[1])], loop[size_t(t[2])]});
    if (result.triangle.size() + 2 != loop.size())
        return std::nullopt;
    result.beside = *std::min_element(beside.begin(), beside.end());
    return result;
}

} // namespace spia
