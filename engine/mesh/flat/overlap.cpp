#include "engine/mesh/flat/overlap.h"

#include <algorithm>
#include <tuple>

#include "engine/mesh/orient2d.h"
#include "engine/mesh/topology.h"

namespace spia {

namespace {

/// Where the sheet is pinched to a point the mesh has two vertices at one place, and the layout
/// puts them there up to rounding: there they are put onto each other, to touch and not to cross.
Eigen::Matrix2Xd with_pinches_closed(const TriMesh& part, const std::vector<std::vector<int>>& loops,
                                     const Eigen::Matrix2Xd& flat)
{
    constexpr double rounding = 1e-9; // of the size of the layout
    std::vector<int> border;
    for (const std::vector<int>& loop : loops)
        border.insert(border.end(), loop.begin(), loop.end());
    const auto key = [&](int v) {
        return std::tuple(part.position(0, v), part.position(1, v), part.position(2, v), v);
    };
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

/// Each border vertex drawn into the sheet by so much, along the middle of what there is of it
/// around the vertex; at the tip of a slit, where that is all around, it stays.
Eigen::Matrix2Xd drawn_in(const TriMesh& part, const std::vector<std::vector<int>>& loops, const Eigen::Matrix2Xd& flat,
                          double by)
{
    Eigen::Matrix2Xd way = Eigen::Matrix2Xd::Zero(2, flat.cols());
    for (int f = 0; f < part.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = part.triangle(k, f);
            // The integral of the unit vectors from a to b: of (cos, sin) it is (sin, -cos).
            const Eigen::Vector2d a = (flat.col(part.triangle((k + 1) % 3, f)) - flat.col(v)).normalized(),
                                  b = (flat.col(part.triangle((k + 2) % 3, f)) - flat.col(v)).normalized();
            way.col(v) += Eigen::Vector2d(b.y() - a.y(), a.x() - b.x());
        }
    constexpr double all_around = 1e-3; // of twice a unit vector, as it is at a straight border:
                                        // but for 0.06 degrees
    Eigen::Matrix2Xd result = flat;
    for (const std::vector<int>& loop : loops)
        for (const int v : loop)
            if (const double length = way.col(v).norm(); length > 2 * all_around)
                result.col(v) += by / length * way.col(v);
    return result;
}

/// Vertices whose faces go around them more than once.
std::vector<int> wound(const TriMesh& part, const std::vector<std::vector<int>>& loops, const Eigen::Matrix2Xd& flat)
{
    // Count the triangles around a vertex that hold one and the same direction: at the boundary
    // that of its first edge.
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
    std::vector<int> result;
    for (size_t v = 0; v < times.size(); ++v)
        if (times[v] > 1)
            result.push_back(int(v));
    return result;
}

/// A crossing near a vertex may be that of the edge before or beyond it as well.
bool about_the_same(const OutlineCrossing& c, const OutlineCrossing& d)
{
    const auto touch = [](const std::array<int, 2>& e, const std::array<int, 2>& f) {
        return e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1];
    };
    return (touch(c.edge, d.edge) && touch(c.other, d.other)) || (touch(c.edge, d.other) && touch(c.other, d.edge));
}

} // namespace

Overlap overlap(const TriMesh& part, const Eigen::Matrix2Xd& flat)
{
    const auto loops = boundary_loops(part);
    Overlap result{outline_crossings(loops, with_pinches_closed(part, loops, flat)), wound(part, loops, flat)};
    if (result.none())
        return result;
    // The lips of a slit whose tongue is bent away come to lie on each other up to rounding only.
    // What still lies on itself once all edges are drawn in by more than that does so indeed.
    constexpr double rounding = 1e-6; // of the size of the layout: single precision of STL files is
                                      // a tenth of that
    const Eigen::Matrix2Xd inner =
        drawn_in(part, loops, flat, rounding * (flat.rowwise().maxCoeff() - flat.rowwise().minCoeff()).norm());
    const std::vector<OutlineCrossing> crossing = outline_crossings(loops, inner);
    const std::vector<int> winding = wound(part, loops, inner);
    std::erase_if(result.crossings, [&](const OutlineCrossing& c) {
        return std::ranges::none_of(crossing, [&](const OutlineCrossing& d) { return about_the_same(c, d); });
    });
    std::erase_if(result.wound, [&](int v) { return std::ranges::count(winding, v) == 0; });
    return result;
}

} // namespace spia
