#include "engine/mesh/closest_point.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/mesh/box_tree.h"

namespace spia {

namespace {

/// Share of b in the place of the segment ab that is nearest to the point; 0 for a segment of no
/// length.
double closest_on_segment(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& point)
{
    const double along = (b - a).dot(point - a), squared_length = (b - a).squaredNorm();
    return along <= 0 ? 0 : along >= squared_length ? 1 : along / squared_length;
}

/// Without branches, which are as often taken as not: Eigen's has six.
double squared_distance(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& point)
{
    return (box.min() - point).cwiseMax(point - box.max()).cwiseMax(0.0).squaredNorm();
}

} // namespace

Eigen::Vector3d closest_on_triangle(const Eigen::Matrix3d& triangle, const Eigen::Vector3d& point)
{
    // Inside the prism over the triangle it is the foot of the perpendicular: all three areas it
    // spans with the edges are on the inner side. Else it is on one of the edges.
    const Eigen::Vector3d edge_1 = triangle.col(1) - triangle.col(0), edge_2 = triangle.col(2) - triangle.col(0);
    const Eigen::Vector3d normal = edge_1.cross(edge_2);
    Eigen::Vector3d inner;
    for (int k = 0; k < 3; ++k) {
        const auto a = triangle.col((k + 1) % 3), b = triangle.col((k + 2) % 3);
        inner[k] = (b - a).cross(point - a).dot(normal);
    }
    const bool inside = inner.minCoeff() >= 0 && inner.sum() > 0;
    // The foot loses as many digits as the triangle is thin; on a needle an edge may be the better
    // answer.
    constexpr double needle = 1e-6;
    if (inside && normal.norm() > needle * std::max(edge_1.squaredNorm(), edge_2.squaredNorm()))
        return inner / inner.sum();

    Eigen::Vector3d best;
    double best_squared = std::numeric_limits<double>::infinity();
    const auto consider = [&](const Eigen::Vector3d& barycentric) {
        const double squared = (triangle * barycentric - point).squaredNorm();
        if (squared < best_squared) {
            best_squared = squared;
            best = barycentric;
        }
    };
    for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3;
        const double t = closest_on_segment(triangle.col(k), triangle.col(l), point);
        Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
        barycentric[k] = 1 - t;
        barycentric[l] = t;
        consider(barycentric);
    }
    if (inside)
        consider(inner / inner.sum());
    return best;
}

ClosestPointSearch::ClosestPointSearch(const TriMesh& mesh, const Progress& progress)
    : tree_(std::make_unique<const BoxTree>(mesh, BoxTree::Boxes::pieces, progress))
{
}
ClosestPointSearch::~ClosestPointSearch() = default;
ClosestPointSearch::ClosestPointSearch(ClosestPointSearch&&) noexcept = default;
ClosestPointSearch& ClosestPointSearch::operator=(ClosestPointSearch&&) noexcept = default;

ClosestPoint ClosestPointSearch::nearest(const Eigen::Vector3d& point, double within) const
{
    struct Waiting {
        int node;
        double squared; ///< distance of the node's box
    };
    std::array<Waiting, BoxTree::most_levels> stack; // one waits per level
    int waiting = 0;
    double best = within * within;
    int found = -1;
    ClosestPoint result;
    stack[size_t(waiting++)] = {0, squared_distance(tree_->node[0].box, point)};
    while (waiting > 0) {
        Waiting here = stack[size_t(--waiting)];
        // Equally near boxes are opened too, so that of equally near faces the one of smallest
        // index is found.
        while (here.squared <= best) {
            const BoxTree::Node& node = tree_->node[size_t(here.node)];
            if (node.count > 0) {
                for (int i = node.first; i < node.first + node.count; ++i) {
                    if (tree_->face[size_t(i)] == found || // seen as another piece
                        squared_distance(tree_->box[size_t(i)], point) > best)
                        continue;
                    const Eigen::Matrix3d& triangle = tree_->triangle[size_t(i)];
                    const Eigen::Vector3d barycentric = closest_on_triangle(triangle, point);
                    const Eigen::Vector3d position = triangle * barycentric;
                    const double squared = (position - point).squaredNorm();
                    const int face = tree_->face[size_t(i)];
                    if (squared < best || (squared == best && (found < 0 || face < found))) {
                        best = squared;
                        found = face;
                        result.barycentric = barycentric;
                        result.position = position;
                    }
                }
                break;
            }
            Waiting near = {here.node + 1, squared_distance(tree_->node[size_t(here.node) + 1].box, point)};
            Waiting far = {node.second, squared_distance(tree_->node[size_t(node.second)].box, point)};
            if (far.squared < near.squared)
                std::swap(near, far);
            stack[size_t(waiting++)] = far;
            here = near;
        }
    }
    result.face = found;
    if (found >= 0)
        result.distance = std::sqrt(best);
    return result;
}

} // namespace spia
