#include "engine/mesh/pick.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/infinity.h"
#include "engine/mesh/box_tree.h"

namespace spia {
namespace {

/// A ray, prepared for many tests [Woop, Benthin, Wald: Watertight Ray/Triangle Intersection,
/// 2013].
class PreparedRay {
public:
    PreparedRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
        : origin_(origin), inverse_(direction.cwiseInverse())
    {
        for (int k = 0; k < 3; ++k)
            backwards_[size_t(k)] = std::signbit(inverse_[k]);
        direction.cwiseAbs().maxCoeff(&z_);
        x_ = (z_ + 1) % 3;
        y_ = (z_ + 2) % 3;
        shear_ = {direction[x_] / direction[z_], direction[y_] / direction[z_], 1 / direction[z_]};
    }

    /// Distance at which the ray enters the box, infinity if it does not or only beyond `most`.
    double enters(const Eigen::AlignedBox3d& box, double most) const
    {
        double near = 0, far = most;
        for (int k = 0; k < 3; ++k) {
            // Of a ray along a side of the box one of them is 0 * infinity, not a number. In this
            // order of the arguments such a side does not limit.
            near = std::max(near, ((backwards_[size_t(k)] ? box.max() : box.min())[k] - origin_[k]) * inverse_[k]);
            far = std::min(far, ((backwards_[size_t(k)] ? box.min() : box.max())[k] - origin_[k]) * inverse_[k]);
        }
        constexpr double rounding = 1 + 8 * std::numeric_limits<double>::epsilon();
        return near <= far * rounding ? near : infinity;
    }

    /// Distance to the triangle (columns: its vertices), infinity if the ray misses it. Two
    /// triangles see a common edge with the same rounding, so that no ray misses both.
    double meets(const Eigen::Matrix3d& triangle, Eigen::Vector3d& barycentric) const
    {
        const Eigen::Vector2d a = sheared(triangle.col(0)), b = sheared(triangle.col(1)), c = sheared(triangle.col(2));
        const double u = c.x() * b.y() - c.y() * b.x(), v = a.x() * c.y() - a.y() * c.x(),
                     w = b.x() * a.y() - b.y() * a.x();
        if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0))
            return infinity;
        const double sum = u + v + w;
        if (sum == 0) // seen from its edge
            return infinity;
        barycentric = Eigen::Vector3d(u, v, w) / sum;
        const double distance = (barycentric.dot(triangle.row(z_)) - origin_[z_]) * shear_.z();
        return distance >= 0 ? distance : infinity;
    }

private:
    Eigen::Vector2d sheared(const Eigen::Vector3d& place) const
    {
        const Eigen::Vector3d from = place - origin_;
        return {from[x_] - shear_.x() * from[z_], from[y_] - shear_.y() * from[z_]};
    }

    Eigen::Vector3d origin_, inverse_, shear_;
    std::array<bool, 3> backwards_;
    Eigen::Index x_, y_, z_;
};

/// Calls visit(i) with the places in the tree of all faces whose boxes the ray meets within `most`,
/// near ones first as far as the tree knows; visit may lessen `most`.
template <class Visit> void walk(const BoxTree& tree, const PreparedRay& ray, double& most, const Visit& visit)
{
    struct Waiting {
        int node;
        double distance;
    };
    std::array<Waiting, BoxTree::most_levels> stack; // one waits per level
    int waiting = 0;
    stack[size_t(waiting++)] = {0, ray.enters(tree.node[0].box, most)};
    while (waiting > 0) {
        Waiting here = stack[size_t(--waiting)];
        // Equally near boxes are opened too, so that of equally near faces the one of lowest index
        // is found.
        while (here.distance <= most && here.distance < infinity) {
            const BoxTree::Node& node = tree.node[size_t(here.node)];
            if (node.count > 0) {
                for (int i = node.first; i < node.first + node.count; ++i)
                    visit(size_t(i));
                break;
            }
            Waiting near = {here.node + 1, ray.enters(tree.node[size_t(here.node) + 1].box, most)};
            Waiting far = {node.second, ray.enters(tree.node[size_t(node.second)].box, most)};
            if (far.distance < near.distance)
                std::swap(near, far);
            stack[size_t(waiting++)] = far;
            here = near;
        }
    }
}

} // namespace

RayPicker::RayPicker(const TriMesh& mesh)
    : tree_(std::make_unique<const BoxTree>(mesh)), touching_(1e-9 * box().sizes().norm())
{
}
RayPicker::~RayPicker() = default;
RayPicker::RayPicker(RayPicker&&) noexcept = default;
RayPicker& RayPicker::operator=(RayPicker&&) noexcept = default;

const Eigen::AlignedBox3d& RayPicker::box() const { return tree_->node[0].box; }

RayHit RayPicker::first(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const
{
    const PreparedRay ray(origin, direction);
    RayHit best;
    double most = infinity;
    walk(*tree_, ray, most, [&](size_t i) {
        Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
        const double distance = ray.meets(tree_->triangle[i], barycentric);
        const int face = tree_->face[i];
        if (distance < most || (distance == most && distance < infinity && face < best.face)) {
            most = distance;
            best = {face, barycentric, distance};
        }
    });
    return best;
}

bool RayPicker::hidden(int face, const Eigen::Vector3d& place, const Eigen::Vector3d& eye) const
{
    const double length = (place - eye).norm();
    if (!(length > touching_))
        return false;
    // From the place to the eye, not back: what hides it is often near.
    const PreparedRay ray(place, (eye - place) / length);
    double most = length;
    bool found = false;
    walk(*tree_, ray, most, [&](size_t i) {
        Eigen::Vector3d barycentric;
        if (found || tree_->face[i] == face)
            return;
        const double distance = ray.meets(tree_->triangle[i], barycentric);
        if (distance > touching_ && distance < length) {
            found = true;
            most = -1; // nothing more is looked at
        }
    });
    return found;
}

std::vector<int> RayPicker::near(const Eigen::Matrix4Xd& half_spaces) const
{
    std::vector<int> result;
    std::vector<int> stack = {0};
    while (!stack.empty()) {
        const int at = stack.back();
        stack.pop_back();
        const BoxTree::Node& node = tree_->node[size_t(at)];
        const bool outside = [&] {
            for (const auto& h : half_spaces.colwise()) {
                // the corner that is farthest inside
                const Eigen::Vector3d corner = (h.head<3>().array() > 0).select(node.box.max(), node.box.min());
                if (h.head<3>().dot(corner) + h[3] < 0)
                    return true;
            }
            return false;
        }();
        if (outside)
            continue;
        if (node.count > 0) {
            for (int i = node.first; i < node.first + node.count; ++i)
                result.push_back(tree_->face[size_t(i)]);
        } else {
            stack.push_back(node.second);
            stack.push_back(at + 1);
        }
    }
    return result;
}

} // namespace spia
