#include "app/viewer/model/document/step_motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/mesh/topology.h"

namespace spia::viewer {
namespace {

/// Axis (unit) and angle of the turn of the sheet at a vertex. @param general the axis of the sheet
/// around, for a half turn, which has none of its own
struct Turn {
    Eigen::Vector3d axis;
    double angle;
};
Turn turn_of(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& way,
             const Eigen::Vector3d& general)
{
    constexpr double half_turn = 0.98 * std::numbers::pi;
    const Eigen::Vector3d cross = from.cross(to);
    const double angle = std::atan2(cross.norm(), from.dot(to));
    if (angle < half_turn)
        return {cross.stableNormalized(), angle};
    Eigen::Vector3d axis = from.cross(way).stableNormalized();
    if (axis.dot(general) < 0)
        axis = -axis;
    return {axis, axis.isZero(0) ? 0 : angle};
}

} // namespace

Eigen::Matrix3Xd on_the_way(const Eigen::Matrix3Xi& triangle, const Eigen::Matrix3Xd& before,
                            const Eigen::Matrix3Xd& after, double share)
{
    if (share <= 0)
        return before;
    if (share >= 1)
        return after;
    const Eigen::Matrix3Xd from = vertex_normals(TriMesh{before, triangle}),
                           to = vertex_normals(TriMesh{after, triangle});
    Eigen::Vector3d general = Eigen::Vector3d::Zero();
    for (Eigen::Index v = 0; v < before.cols(); ++v)
        general += from.col(v).cross(to.col(v));
    Eigen::Matrix3Xd place = before;
    for (Eigen::Index v = 0; v < before.cols(); ++v) {
        const Eigen::Vector3d way = after.col(v) - before.col(v);
        if (way.isZero(0))
            continue;
        // The chord of the part of the arc that is behind it.
        const Turn turn = turn_of(from.col(v), to.col(v), way, general);
        const Eigen::Vector3d along = turn.axis.dot(way) * turn.axis, across = way - along;
        const double half = turn.angle / 2, length = half > 1e-6 ? std::sin(half * share) / std::sin(half) : share;
        place.col(v) += share * along + length * (Eigen::AngleAxisd(half * (share - 1), turn.axis) * across);
    }
    return place;
}

} // namespace spia::viewer
