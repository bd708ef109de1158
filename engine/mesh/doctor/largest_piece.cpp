#include "engine/mesh/doctor/largest_piece.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/flat_triangles.h"

namespace spia {
namespace {

using Eigen::Vector3d;

/// Unit vector in the face, perpendicular to its edge, away from it; zero for a face without area.
Vector3d into_face(const EdgeUse& edge, const Triangle& face, const std::vector<Vector3d>& position)
{
    const Vector3d &low = position[size_t(edge.low)], &high = position[size_t(edge.high)];
    const Vector3d along = (high - low).normalized();
    for (const int v : face)
        if (v != edge.low && v != edge.high) {
            const Vector3d up = position[size_t(v)] - low;
            return (up - up.dot(along) * along).normalized();
        }
    return Vector3d::Zero();
}

} // namespace

Pieces smooth_pieces(const std::vector<Triangle>& triangles, const std::vector<Vector3d>& position)
{
    DisjointSets sets(triangles.size());
    const auto uses = edge_uses(triangles);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        size_t a = begin, b = begin + 1;
        double smoothest = 2;
        for (size_t i = begin; end - begin > 2 && i < end; ++i)
            for (size_t j = i + 1; j < end; ++j) {
                const double turn = into_face(uses[i], triangles[size_t(uses[i].face)], position)
                                        .dot(into_face(uses[j], triangles[size_t(uses[j].face)], position));
                if (turn < smoothest) { // -1: straight on
                    smoothest = turn;
                    a = i;
                    b = j;
                }
            }
        if (b < end)
            sets.join(uses[a].face, uses[b].face);
    });

    Pieces result;
    result.of.resize(triangles.size());
    std::vector<int> number(triangles.size(), -1);
    std::vector<double> area;
    for (size_t f = 0; f < triangles.size(); ++f) {
        int& piece = number[size_t(sets.root(int(f)))];
        if (piece < 0) {
            piece = result.count++;
            area.push_back(0);
        }
        result.of[f] = piece;
        const Vector3d& a = position[size_t(triangles[f][0])];
        area[size_t(piece)] +=
            (position[size_t(triangles[f][1])] - a).cross(position[size_t(triangles[f][2])] - a).norm();
    }
    if (result.count > 0)
        result.largest = int(std::max_element(area.begin(), area.end()) - area.begin());
    return result;
}

} // namespace spia
