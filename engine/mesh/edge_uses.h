#pragma once
#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

namespace spia {

using Triangle = std::array<int, 3>;

/// One side of one triangle.
struct EdgeUse {
    int low, high; ///< the two vertices, low < high
    int face;
    bool forward; ///< the triangle runs from low to high
};

/// All sides of all triangles; uses of the same edge stand side by side, in the order of the faces.
inline std::vector<EdgeUse> edge_uses(const std::vector<Triangle>& triangles)
{
    std::vector<EdgeUse> uses;
    uses.reserve(3 * triangles.size());
    for (size_t f = 0; f < triangles.size(); ++f)
        for (size_t k = 0; k < 3; ++k) {
            const int a = triangles[f][k], b = triangles[f][(k + 1) % 3];
            uses.push_back({std::min(a, b), std::max(a, b), int(f), a < b});
        }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
    });
    return uses;
}

/// Calls visit(begin, end) with the uses [begin, end) of each edge in turn.
template <class Visit> void for_each_edge(const std::vector<EdgeUse>& uses, const Visit& visit)
{
    for (size_t begin = 0, end; begin < uses.size(); begin = end) {
        for (end = begin + 1; end < uses.size(); ++end)
            if (uses[end].low != uses[begin].low || uses[end].high != uses[begin].high)
                break;
        visit(begin, end);
    }
}

} // namespace spia
