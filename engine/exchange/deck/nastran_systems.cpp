#include "engine/exchange/deck/nastran_systems.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

namespace spia {
namespace {

/// Coordinates as lengths along the axes.
Eigen::Vector3d along_axes(NastranSystems::Kind kind, const Eigen::Vector3d& c)
{
    constexpr double degree = std::numbers::pi / 180;
    if (kind == NastranSystems::Kind::cylindrical)
        return {c[0] * std::cos(c[1] * degree), c[0] * std::sin(c[1] * degree), c[2]};
    if (kind == NastranSystems::Kind::spherical) {
        // the second is the angle from the third axis
        const double across = c[0] * std::sin(c[1] * degree);
        return {across * std::cos(c[2] * degree), across * std::sin(c[2] * degree), c[0] * std::cos(c[1] * degree)};
    }
    return c;
}

} // namespace

std::optional<Eigen::Vector3d> NastranSystems::in_space(std::int64_t id, const Eigen::Vector3d& coordinates)
{
    if (id == 0)
        return coordinates;
    const std::optional<Frame>& system = frame(id);
    if (!system)
        return std::nullopt;
    return Eigen::Vector3d(system->origin + system->axes * along_axes(system->kind, coordinates));
}

const std::optional<NastranSystems::Frame>& NastranSystems::frame(std::int64_t id)
{
    // Down to systems that are known, then up again: no recursion on what a file says.
    std::vector<std::int64_t> open = {id};
    std::set<std::int64_t> under_way;
    while (!open.empty()) {
        const std::int64_t here = open.back();
        if (frame_.contains(here)) {
            open.pop_back();
            continue;
        }
        const auto system = system_.find(here);
        if (system == system_.end()) {
            frame_[here] = std::nullopt;
            continue;
        }
        const bool again = !under_way.insert(here).second;
        bool waits = false;
        for (const std::int64_t reference : system->second.reference)
            if (reference != 0 && !frame_.contains(reference)) {
                waits = true;
                if (under_way.contains(reference)) // it refers to itself
                    frame_[reference] = std::nullopt;
                else
                    open.push_back(reference);
            }
        if (!waits || (again && open.back() == here))
            frame_[here] = frame_of(system->second);
    }
    return frame_.at(id);
}

std::optional<NastranSystems::Frame> NastranSystems::frame_of(const System& system) const
{
    Eigen::Matrix3d points;
    for (int k = 0; k < 3; ++k) {
        const std::int64_t reference = system.reference[size_t(k)];
        if (reference == 0) {
            points.col(k) = system.points.col(k);
            continue;
        }
        const std::optional<Frame>& outer = frame_.at(reference);
        if (!outer)
            return std::nullopt;
        points.col(k) = outer->origin + outer->axes * along_axes(outer->kind, system.points.col(k));
    }
    const Eigen::Vector3d third = points.col(1) - points.col(0), side = points.col(2) - points.col(0);
    const Eigen::Vector3d second = third.cross(side);
    constexpr double in_line = 1e-10; // sine of the angle between them
    if (!(second.norm() > in_line * third.norm() * side.norm()))
        return std::nullopt;
    Eigen::Matrix3d axes;
    axes.col(2) = third.normalized();
    axes.col(1) = second.normalized();
    axes.col(0) = axes.col(1).cross(axes.col(2));
    return Frame{system.kind, points.col(0), axes};
}

} // namespace spia
