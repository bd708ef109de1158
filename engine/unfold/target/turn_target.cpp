#include "engine/unfold/target/turn_target.h"
#include "engine/core/angle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace spia {
namespace {

/// Where a round face begins to count its angles.
struct FaceAround {
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
        reached = std::max(reached, arc.to - full_turn);
    for (size_t k = 0; k <= arcs.size(); ++k) {
        const double next = k < arcs.size() ? arcs[k].from : arcs[0].from + full_turn;
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

bool turn_to(const FaceAround& face, const Eigen::Matrix3Xd& point, const std::vector<std::array<int, 2>>& edges)
{
    Eigen::VectorXd angle(point.cols());
    for (Eigen::Index v = 0; v < point.cols(); ++v)
        angle[v] = face.angle(point.col(v));
    const std::optional<double> middle = middle_around(angle, edges);
    if (!middle)
        return false;
    face.towards =
        (std::cos(*middle) * face.towards + std::sin(*middle) * face.axis.cross(face.towards)).normalized().eval();
    return true;
}

/// Per point how many turns it is beyond where its angle is counted, along the edges from point 0;
/// none: of a closed way some are left.
std::optional<std::vector<int>> turns_along(const Eigen::VectorXd& angle, const std::vector<std::array<int, 2>>& edges)
{
    std::vector<std::vector<int>> beside(size_t(angle.size()));
    for (const auto& [a, b] : edges) {
        beside[size_t(a)].push_back(b);
        beside[size_t(b)].push_back(a);
    }
    const auto over = [&](int a, int b) { // turns that the short way from a to b adds
        return int(std::lround((std::remainder(angle[b] - angle[a], full_turn) - (angle[b] - angle[a])) / full_turn));
    };
    std::vector<int> turns(beside.size(), 0);
    std::vector<char> seen(beside.size(), 0);
    std::vector<int> queue = {0};
    seen[0] = 1;
    for (size_t k = 0; k < queue.size(); ++k)
        for (const int b : beside[size_t(queue[k])])
            if (!seen[size_t(b)]) {
                seen[size_t(b)] = 1;
                turns[size_t(b)] = turns[size_t(queue[k])] + over(queue[k], b);
                queue.push_back(b);
            }
    for (const auto& [a, b] : edges)
        if (turns[size_t(b)] != turns[size_t(a)] + over(a, b))
            return std::nullopt;
    return turns;
}

} // namespace

std::optional<double> middle_around(const Eigen::VectorXd& angle, const std::vector<std::array<int, 2>>& edges)
{
    if (angle.size() == 0)
        return std::nullopt;
    std::vector<Arc> arcs;
    const auto add = [&](double from, double length) {
        from -= full_turn * std::floor(from / full_turn);
        arcs.push_back({from, from + length});
    };
    for (const double a : angle)
        add(a, 0);
    for (const auto& [a, b] : edges) {
        const double way = std::remainder(angle[b] - angle[a], full_turn);
        add(way >= 0 ? angle[a] : angle[b], std::abs(way));
    }
    const std::optional<double> gap = middle_of_gap(std::move(arcs));
    return gap ? std::optional(*gap + full_turn / 2) : std::nullopt;
}

TargetSurface turned_over(const TargetSurface& face)
{
    TargetSurface out = face;
    if (auto* plane = std::get_if<PlaneFace>(&out))
        plane->axes = plane->axes.rowwise().reverse().eval();
    else if (auto* height = std::get_if<HeightFace>(&out)) { // x and y change places, and up is
                                                             // down
        height->axes = height->axes.rowwise().reverse().eval();
        height->corner = height->corner.reverse().eval();
        height->coefficient = -height->coefficient.transpose().eval();
    } else if (auto* cylinder = std::get_if<CylinderFace>(&out))
        cylinder->bulges = !cylinder->bulges;
    else if (auto* cone = std::get_if<ConeFace>(&out))
        cone->bulges = !cone->bulges;
    return out;
}

std::optional<TargetSurface> turned_towards(const TargetSurface& face, const Eigen::Matrix3Xd& point,
                                            const std::vector<std::array<int, 2>>& edges)
{
    TargetSurface out = face;
    bool open = true;
    if (point.cols() == 0)
        return out;
    if (auto* cylinder = std::get_if<CylinderFace>(&out))
        open = turn_to({cylinder->origin, cylinder->axis, cylinder->towards}, point, edges);
    else if (auto* cone = std::get_if<ConeFace>(&out))
        open = turn_to({cone->apex, cone->axis, cone->towards}, point, edges);
    return open ? std::optional(out) : std::nullopt;
}

std::optional<Eigen::Matrix2Xd> unwound(const TargetSurface& face, const Eigen::Matrix3Xd& point,
                                        const std::vector<std::array<int, 2>>& edges)
{
    Eigen::Matrix2Xd places(2, point.cols());
    for (Eigen::Index v = 0; v < point.cols(); ++v)
        places.col(v) = developed(face, point.col(v));
    TargetSurface round = face;
    const auto angles = [&](const FaceAround& around) {
        Eigen::VectorXd angle(point.cols());
        for (Eigen::Index v = 0; v < point.cols(); ++v)
            angle[v] = around.angle(point.col(v));
        return angle;
    };
    if (auto* cylinder = std::get_if<CylinderFace>(&round)) {
        const auto turns = turns_along(angles({cylinder->origin, cylinder->axis, cylinder->towards}), edges);
        if (!turns)
            return std::nullopt;
        for (Eigen::Index v = 0; v < point.cols(); ++v)
            places(0, v) += (cylinder->bulges ? 1 : -1) * cylinder->radius * full_turn * (*turns)[size_t(v)];
    } else if (auto* cone = std::get_if<ConeFace>(&round)) {
        const auto turns = turns_along(angles({cone->apex, cone->axis, cone->towards}), edges);
        if (!turns)
            return std::nullopt;
        const double flat_turn = (cone->bulges ? -1 : 1) * std::sin(cone->half_angle) * full_turn;
        for (Eigen::Index v = 0; v < point.cols(); ++v)
            places.col(v) = (Eigen::Rotation2Dd(flat_turn * (*turns)[size_t(v)]) * places.col(v)).eval();
    }
    return places;
}

} // namespace spia
