#pragma once
#include "engine/mesh/edge_uses.h"

namespace spia {

/// 3 by #F: the face across the edge from corner k to the next one; -1 where there is none or there
/// are more than one.
/// @param uses  edge_uses() of the faces
inline Eigen::Matrix3Xi face_neighbours(int faces, const std::vector<EdgeUse>& uses)
{
    Eigen::Matrix3Xi neighbour = Eigen::Matrix3Xi::Constant(3, faces, -1);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        if (end != begin + 2)
            return;
        neighbour(uses[begin].corner, uses[begin].face) = uses[begin + 1].face;
        neighbour(uses[begin + 1].corner, uses[begin + 1].face) = uses[begin].face;
    });
    return neighbour;
}

} // namespace spia
