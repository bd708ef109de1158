#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

namespace spia {

using Triangle = std::array<int, 3>;

/// One side of one triangle.
struct EdgeUse {
    int low, high;    ///< the two vertices, low < high
    int face, corner; ///< the side runs from this corner of the face to the next one
    bool forward;     ///< and from low to high

    bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

/// All sides of all triangles; uses of the same edge stand side by side, in the order of the faces.
/// @param vertex vertex(face, corner) is its number
template <class Vertex> std::vector<EdgeUse> edge_uses(int faces, const Vertex& vertex)
{
    std::vector<EdgeUse> uses;
    uses.reserve(3 * size_t(faces));
    for (int f = 0; f < faces; ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = vertex(f, k), b = vertex(f, (k + 1) % 3);
            uses.push_back({std::min(a, b), std::max(a, b), f, k, a < b});
        }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
    });
    return uses;
}

inline std::vector<EdgeUse> edge_uses(const std::vector<Triangle>& triangles)
{
    return edge_uses(int(triangles.size()), [&](int f, int k) { return triangles[size_t(f)][size_t(k)]; });
}

inline std::vector<EdgeUse> edge_uses(const Eigen::Matrix3Xi& triangle)
{
    return edge_uses(int(triangle.cols()), [&](int f, int k) { return triangle(k, f); });
}

/// Calls visit(begin, end) with the uses [begin, end) of each edge in turn.
template <class Visit> void for_each_edge(const std::vector<EdgeUse>& uses, const Visit& visit)
{
    for (size_t begin = 0, end; begin < uses.size(); begin = end) {
        for (end = begin + 1; end < uses.size(); ++end)
            if (!uses[end].same_edge(uses[begin]))
                break;
        visit(begin, end);
    }
}

} // namespace spia
