#include "engine/mesh/closest_point.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <numeric>
#include <vector>

#include "engine/core/error.h"

namespace spia {

namespace {

using Box = Eigen::AlignedBox<double, 3>;

/// Share of b in the place of the segment ab that is nearest to the point; 0 for a segment of no length.
double closest_on_segment(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& point)
{
    const double along = (b - a).dot(point - a), squared_length = (b - a).squaredNorm();
    return along <= 0 ? 0 : along >= squared_length ? 1 : along / squared_length;
}

void require_usable(const TriMesh& mesh)
{
    if (mesh.triangles() == 0)
        throw InputError("a mesh without faces has no closest point; read or mesh the part again");
    for (int f = 0; f < mesh.triangles(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.triangle(k, f);
            if (v < 0 || v >= mesh.vertices())
                throw InputError(fmt::format("face {} names vertex {}, but there are {} vertices; mend the mesh there",
                                             f, v, mesh.vertices()));
            if (!mesh.position.col(v).allFinite())
                throw InputError(fmt::format("vertex {} of face {} has a coordinate that is not a number; mend the "
                                             "mesh there",
                                             v, f));
        }
}

} // namespace

Eigen::Vector3d closest_on_triangle(const Eigen::Matrix3d& triangle, const Eigen::Vector3d& point)
{
    // Inside the prism over the triangle it is the foot of the perpendicular: all three areas it spans with the edges
    // are on the inner side. Else it is on one of the edges.
    const Eigen::Vector3d edge_1 = triangle.col(1) - triangle.col(0), edge_2 = triangle.col(2) - triangle.col(0);
    const Eigen::Vector3d normal = edge_1.cross(edge_2);
    Eigen::Vector3d inner;
    for (int k = 0; k < 3; ++k) {
        const auto a = triangle.col((k + 1) % 3), b = triangle.col((k + 2) % 3);
        inner[k] = (b - a).cross(point - a).dot(normal);
    }
    const bool inside = inner.minCoeff() >= 0 && inner.sum() > 0;
    // The foot loses as many digits as the triangle is thin; on a needle an edge may be the better answer.
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

/// A binary tree of boxes. The faces are halved at the median of their boxes' middles along the longest side, down to a
/// few faces per leaf. On 100 000 triangles it answers in 1.3 us, Boost.Geometry's R-tree (1.74) in 5 us and only if 32
/// candidate boxes are enough: its search for neighbours can be limited by their number, not by their distance.
struct ClosestPointSearch::Tree {
    struct Node {
        Box box;
        int second = 0;           ///< inner node: its second child (the first one is the next node)
        int first = 0, count = 0; ///< leaf: its faces [first, first + count) in face order of the tree
    };
    static constexpr int leaf_size = 4;

    std::vector<Node> node;
    std::vector<int> face;                 ///< of the mesh, in the order of the leaves
    std::vector<Eigen::Matrix3d> triangle; ///< its vertices, in the same order

    explicit Tree(const TriMesh& mesh) : face(size_t(mesh.triangles()))
    {
        std::iota(face.begin(), face.end(), 0);
        std::vector<Box> box(face.size());
        for (int f = 0; f < mesh.triangles(); ++f)
            for (int k = 0; k < 3; ++k)
                box[size_t(f)].extend(mesh.position.col(mesh.triangle(k, f)));
        node.reserve(face.size());
        build(box, 0, mesh.triangles());
        triangle.resize(face.size());
        for (size_t i = 0; i < face.size(); ++i)
            for (int k = 0; k < 3; ++k)
                triangle[i].col(k) = mesh.position.col(mesh.triangle(k, face[i]));
    }

    void build(const std::vector<Box>& box, int from, int to)
    {
        const size_t self = node.size();
        node.emplace_back();
        Box whole, middles;
        for (int i = from; i < to; ++i) {
            whole.extend(box[size_t(face[size_t(i)])]);
            middles.extend(box[size_t(face[size_t(i)])].center());
        }
        node[self].box = whole;
        if (to - from <= leaf_size) {
            node[self].first = from;
            node[self].count = to - from;
            return;
        }
        Eigen::Index axis;
        middles.sizes().maxCoeff(&axis);
        const int half = (from + to) / 2;
        std::nth_element(face.begin() + from, face.begin() + half, face.begin() + to, [&](int a, int b) {
            const double x = box[size_t(a)].center()[axis], y = box[size_t(b)].center()[axis];
            return x < y || (x == y && a < b);
        });
        build(box, from, half);
        node[self].second = int(node.size());
        build(box, half, to);
    }
};

ClosestPointSearch::ClosestPointSearch(const TriMesh& mesh)
{
    require_usable(mesh);
    tree_ = std::make_unique<const Tree>(mesh);
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
    std::array<Waiting, 64> stack; // halving 2^31 faces takes 31 levels, one waits per level
    int waiting = 0;
    double best = within * within;
    int found = -1;
    ClosestPoint result;
    stack[size_t(waiting++)] = {0, tree_->node[0].box.squaredExteriorDistance(point)};
    while (waiting > 0) {
        Waiting here = stack[size_t(--waiting)];
        // Equally near boxes are opened too, so that of equally near faces the one of smallest index is found.
        while (here.squared <= best) {
            const Tree::Node& node = tree_->node[size_t(here.node)];
            if (node.count > 0) {
                for (int i = node.first; i < node.first + node.count; ++i) {
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
            Waiting near = {here.node + 1, tree_->node[size_t(here.node) + 1].box.squaredExteriorDistance(point)};
            Waiting far = {node.second, tree_->node[size_t(node.second)].box.squaredExteriorDistance(point)};
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
