#include "engine/unfold/turn_binder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace spia {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Where a round face begins to count its angles.
struct Around {
    const Eigen::Vector3d &origin, &axis;
    Eigen::Vector3d& towards;

    double angle(const Eigen::Vector3d& point) const
    {
        const Eigen::Vector3d arm = point - origin;
        return std::atan2(axis.cross(towards).dot(arm), towards.dot(arm));
    }
};

struct Arc {
    double from, to; ///< from within [0, one turn), to not before it
};

/// The middle of the largest part of the circle that no arc covers; none: all of it is covered.
std::optional<double> middle_of_gap(std::vector<Arc> arcs)
{
    std::sort(arcs.begin(), arcs.end(), [](const Arc& a, const Arc& b) { return a.from < b.from; });
    double reached = 0, widest = 0, middle = 0;
    for (const Arc& arc : arcs) // what the last arcs cover of the next turn
        reached = std::max(reached, arc.to - turn);
    for (size_t k = 0; k <= arcs.size(); ++k) {
        const double next = k < arcs.size() ? arcs[k].from : arcs[0].from + turn;
        if (k > 0 && next - reached > widest) {
            widest = next - reached;
            middle = (next + reached) / 2;
        }
        if (k < arcs.size())
            reached = std::max(reached, arcs[k].to);
    }
    constexpr double least = 1e-9;
    return widest > least ? std::optional(middle) : std::nullopt;
}

bool turn_to(const Around& face, const Eigen::Matrix3Xd& point, const std::vector<std::array<int, 2>>& edges)
{
    Eigen::VectorXd angle(point.cols());
    for (Eigen::Index v = 0; v < point.cols(); ++v)
        angle[v] = face.angle(point.col(v));
    std::vector<Arc> arcs;
    const auto add = [&](double from, double length) {
        from -= turn * std::floor(from / turn);
        arcs.push_back({from, from + length});
    };
    for (const double a : angle)
        add(a, 0);
    for (const auto& [a, b] : edges) {
        const double way = std::remainder(angle[b] - angle[a], turn);
        add(way >= 0 ? angle[a] : angle[b], std::abs(way));
    }
    const std::optional<double> cut = middle_of_gap(std::move(arcs));
    if (!cut)
        return false;
    const double middle = *cut + turn / 2;
    face.towards =
        (std::cos(middle) * face.towards + std::sin(middle) * face.axis.cross(face.towards)).normalized().eval();
    return true;
}

} // namespace

BinderFace turned_over(const BinderFace& face)
{
    BinderFace out = face;
    if (auto* plane = std::get_if<PlaneFace>(&out))
        plane->axes = plane->axes.rowwise().reverse().eval();
    else if (auto* height = std::get_if<HeightFace>(&out)) { // x and y change places, and up is down
        height->axes = height->axes.rowwise().reverse().eval();
        height->corner = height->corner.reverse().eval();
        height->coefficient = -height->coefficient.transpose().eval();
    } else if (auto* cylinder = std::get_if<CylinderFace>(&out))
        cylinder->bulges = !cylinder->bulges;
    else if (auto* cone = std::get_if<ConeFace>(&out))
        cone->bulges = !cone->bulges;
    return out;
}

std::optional<BinderFace> turned_towards(const BinderFace& face, const Eigen::Matrix3Xd& point,
                                         const std::vector<std::array<int, 2>>& edges)
{
    BinderFace out = face;
    bool open = true;
    if (point.cols() == 0)
        return out;
    if (auto* cylinder = std::get_if<CylinderFace>(&out))
        open = turn_to({cylinder->origin, cylinder->axis, cylinder->towards}, point, edges);
    else if (auto* cone = std::get_if<ConeFace>(&out))
        open = turn_to({cone->apex, cone->axis, cone->towards}, point, edges);
    return open ? std::optional(out) : std::nullopt;
}

} // namespace spia
