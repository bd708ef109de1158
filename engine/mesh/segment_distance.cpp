#include "engine/mesh/segment_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/mesh/box_tree.h"
#include "engine/mesh/nearest_share.h"

namespace spia {
namespace {

double squared_distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
    const Eigen::Vector2d along = b - a;
    const double t = nearest_share(p, a, along);
    return (p - a - t * along).squaredNorm();
}

} // namespace

SegmentDistance::SegmentDistance(const Eigen::Matrix2Xd& position, const std::vector<std::array<int, 2>>& segments)
{
    if (segments.empty())
        return;
    TriMesh mesh;
    mesh.position = Eigen::Matrix3Xd::Zero(3, position.cols());
    mesh.position.topRows<2>() = position;
    mesh.triangle.resize(3, Eigen::Index(segments.size()));
    for (size_t s = 0; s < segments.size(); ++s)
        mesh.triangle.col(Eigen::Index(s)) << segments[s][0], segments[s][1], segments[s][1];
    tree_ = std::make_unique<const BoxTree>(mesh);
    rounding_ = 1e-12 * position.cwiseAbs().maxCoeff();
}
SegmentDistance::~SegmentDistance() = default;

double SegmentDistance::operator()(const Eigen::Vector2d& place) const
{
    double best = std::numeric_limits<double>::infinity();
    if (!tree_)
        return best;
    const Eigen::Vector3d point(place[0], place[1], 0);
    const double rounding = rounding_ + 1e-12 * place.cwiseAbs().maxCoeff();
    const auto away = [&](int node) { return std::sqrt(tree_->node[size_t(node)].box.squaredExteriorDistance(point)); };
    std::vector<std::pair<double, int>> open = {{away(0), 0}};
    while (!open.empty()) {
        const auto [distance, k] = open.back();
        open.pop_back();
        if (distance > std::sqrt(best) + rounding)
            continue;
        const BoxTree::Node& node = tree_->node[size_t(k)];
        for (int i = node.first; i < node.first + node.count; ++i) {
            const Eigen::Matrix3d& ends = tree_->triangle[size_t(i)];
            best = std::min(best, squared_distance(place, ends.col(0).head<2>(), ends.col(1).head<2>()));
        }
        if (node.count > 0)
            continue;
        std::pair near(away(k + 1), k + 1), far(away(node.second), node.second);
        if (far.first < near.first)
            std::swap(near, far);
        open.push_back(far);
        open.push_back(near);
    }
    return std::sqrt(best);
}

} // namespace spia
