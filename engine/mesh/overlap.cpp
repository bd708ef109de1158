#include "engine/mesh/overlap.h"

#include <algorithm>
#include <tuple>

#include "engine/mesh/orient2d.h"
#include "engine/mesh/topology.h"

namespace spia {

namespace {

/// Where the sheet is pinched to a point the mesh has two vertices at one place, and the layout puts them there up to rounding: there
/// they are put onto each other, to touch and not to cross.
Eigen::Matrix2Xd with_pinches_closed(const TriMesh& part, const std::vector<std::vector<int>>& loops,
                                     const Eigen::Matrix2Xd& flat)
{
    constexpr double rounding = 1e-9; // of the size of the layout
    std::vector<int> border;
    for (const std::vector<int>& loop : loops)
        border.insert(border.end(), loop.begin(), loop.end());
    const auto key = [&](int v) { return std::tuple(part.position(0, v), part.position(1, v), part.position(2, v), v); };
    std::sort(border.begin(), border.end(), [&](int v, int w) { return key(v) < key(w); });
    Eigen::Matrix2Xd closed = flat;
    const double near = rounding * (flat.rowwise().maxCoeff() - flat.rowwise().minCoeff()).norm();
    for (size_t i = 1; i < border.size(); ++i) {
        const int v = border[i], w = border[i - 1];
        if (part.position.col(v) == part.position.col(w) && (closed.col(v) - closed.col(w)).norm() <= near)
            closed.col(v) = closed.col(w);
    }
    return closed;
}

} // namespace

Overlap overlap(const TriMesh& part, const Eigen::Matrix2Xd& flat)
{
    const auto loops = boundary_loops(part);
    Overlap result{outline_crossings(loops, with_pinches_closed(part, loops, flat)), {}};
    // Count the triangles around a vertex that hold one and the same direction: at the boundary that of its first edge.
    std::vector<int> towards(size_t(part.vertices()), -1), times(size_t(part.vertices()), 0);
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k)
            towards[size_t(part.triangle(k, f))] = part.triangle((k + 1) % 3, f);
    for (const std::vector<int>& loop : loops)
        for (size_t i = 0; i < loop.size(); ++i)
            towards[size_t(loop[i])] = loop[(i + 1) % loop.size()];
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = part.triangle(k, f);
            const Eigen::Vector2d at = flat.col(v), goal = flat.col(towards[size_t(v)]),
                                  from = flat.col(part.triangle((k + 1) % 3, f)),
                                  to = flat.col(part.triangle((k + 2) % 3, f));
            times[size_t(v)] += orient2d(at, from, goal) >= 0 && orient2d(at, goal, to) > 0;
        }
    for (size_t v = 0; v < times.size(); ++v)
        if (times[v] > 1)
            result.wound.push_back(int(v));
    return result;
}

} // namespace spia
