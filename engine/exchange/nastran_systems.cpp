#include "engine/exchange/nastran_systems.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
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
        const double across = c[0] * std::sin(c[1] * degree); // the second is the angle from the third axis
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
    // From the system down to one that is known, then up again: no recursion on what a file says.
    std::vector<std::int64_t> chain;
    for (std::int64_t next = id; next != 0 && !frame_.contains(next); next = system_.at(next).reference) {
        chain.push_back(next);
        if (!system_.contains(next)) {
            frame_[next] = std::nullopt;
            break;
        }
        if (chain.size() > system_.size()) { // it refers to itself
            for (const std::int64_t each : chain)
                frame_[each] = std::nullopt;
            break;
        }
    }
    for (auto each = chain.rbegin(); each != chain.rend(); ++each) {
        if (frame_.contains(*each))
            continue;
        const System& system = system_.at(*each);
        std::optional<Frame>& result = frame_[*each] = std::nullopt;
        Eigen::Matrix3d points;
        bool placed = true;
        for (int k = 0; k < 3; ++k) {
            const std::optional<Frame>* outer = system.reference ? &frame_.at(system.reference) : nullptr;
            placed = placed && (!outer || *outer);
            if (placed)
                points.col(k) = outer
                                    ? Eigen::Vector3d((*outer)->origin +
                                                      (*outer)->axes * along_axes((*outer)->kind, system.points.col(k)))
                                    : Eigen::Vector3d(system.points.col(k));
        }
        if (!placed)
            continue;
        const Eigen::Vector3d third = points.col(1) - points.col(0), side = points.col(2) - points.col(0);
        const Eigen::Vector3d second = third.cross(side);
        constexpr double in_line = 1e-10; // sine of the angle between them
        if (!(second.norm() > in_line * third.norm() * side.norm()))
            continue;
        Eigen::Matrix3d axes;
        axes.col(2) = third.normalized();
        axes.col(1) = second.normalized();
        axes.col(0) = axes.col(1).cross(axes.col(2));
        result = Frame{system.kind, points.col(0), axes};
    }
    return frame_.at(id);
}

} // namespace spia
