#include "engine/mesh/overlap.h"

#include "engine/mesh/orient2d.h"
#include "engine/mesh/topology.h"

namespace spia {

Overlap overlap(const TriMesh& part, const Eigen::Matrix2Xd& flat)
{
    const auto loops = boundary_loops(part);
    Overlap result{outline_crossings(loops, flat), {}};
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
