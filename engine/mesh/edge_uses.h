#pragma once
#include <Eigen/Core>
#include <array>
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

/// All sides of all triangles; uses of the same edge stand side by side, edges by their lower and
/// then their higher vertex, uses in the order of the faces.
/// @param triangle  vertices, from 0 on
std::vector<EdgeUse> edge_uses(const Eigen::Ref<const Eigen::Matrix3Xi>& triangle);

inline std::vector<EdgeUse> edge_uses(const std::vector<Triangle>& triangles)
{
    return edge_uses(Eigen::Matrix3Xi::Map(triangles.empty() ? nullptr : triangles.front().data(), 3,
                                           Eigen::Index(triangles.size())));
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
