#include "engine/mesh/solid/marks/refilled_mark.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>

#include "engine/mesh/doctor/split_polygon.h"
#include "engine/mesh/solid/marks/refilled_bend.h"

namespace spia {
namespace {

/// The triangle that has the edge from a to b; -1: none.
int face_of_edge(const MarkedSkin& marked, int a, int b)
{
    for (const int f : marked.around[size_t(a)])
        for (int k = 0; k < 3; ++k)
            if (marked.solid.triangle(k, f) == a && marked.solid.triangle((k + 1) % 3, f) == b)
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

/// @param beside  triangles of the skin along the loop
bool is_plane(const MarkedSkin& marked, const std::vector<int>& loop, const std::vector<int>& beside)
{
    constexpr double parallel = 0.9999; // 0.8 degrees: the skin beside it, on average
    const Eigen::Vector3d up = newell(marked.solid, loop).normalized();
    const Eigen::Vector3d middle = marked.solid.position(Eigen::all, loop).rowwise().mean();
    const auto off = [&](int v) { return std::abs(up.dot(marked.solid.position.col(v) - middle)); };
    if (!std::all_of(loop.begin(), loop.end(), [&](int v) { return off(v) <= marked.flat; }))
        return false;
    double along = 0, whole = 0;
    for (const int g : beside) {
        along += up.dot(marked.normal.col(g));
        whole += marked.normal.col(g).norm();
    }
    return std::abs(along) >= parallel * whole;
}

RefilledMark in_plane(const MarkedSkin& marked, const std::vector<int>& loop, const std::vector<int>& beside)
{
    std::vector<Eigen::Vector3d> corners;
    for (const int v : loop)
        corners.push_back(marked.solid.position.col(v));
    RefilledMark result;
    for (const std::array<int, 3>& t : split_polygon(corners))
        result.triangle.push_back({loop[size_t(t[0])], loop[size_t(t[1])], loop[size_t(t[2])]});
    result.beside.assign(result.triangle.size(), *std::min_element(beside.begin(), beside.end()));
    return result;
}

} // namespace

std::optional<RefilledMark> refilled_mark(const MarkedSkin& marked, const std::vector<int>& faces)
{
    std::map<int, int> next;
    std::vector<int> beside;
    for (const int f : faces)
        for (int k = 0; k < 3; ++k) {
            const int a = marked.solid.triangle(k, f), b = marked.solid.triangle((k + 1) % 3, f);
            const int g = face_of_edge(marked, b, a);
            if (g >= 0 && marked.mark[size_t(g)])
                continue;
            if (g < 0 || !marked.skin[size_t(g)] || !next.emplace(a, b).second)
                return std::nullopt;
            beside.push_back(g);
        }
    const std::vector<int> loop = one_loop(next);
    if (loop.size() < 3)
        return std::nullopt;
    std::optional<RefilledMark> result =
        is_plane(marked, loop, beside) ? in_plane(marked, loop, beside) : refilled_bend(marked, loop, beside);
    if (!result || result->triangle.size() + 2 != loop.size() + 2 * result->added.size())
        return std::nullopt; // its polygon crosses itself
    result->vertex = loop.front();
    return result;
}

} // namespace spia
