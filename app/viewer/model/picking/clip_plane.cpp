#include "app/viewer/model/picking/clip_plane.h"

#include <algorithm>
#include <limits>

namespace spia::viewer {

Eigen::Vector3d direction_of(const ClipPlane& clip)
{
    switch (clip.axis) {
    case ClipAxis::x: return Eigen::Vector3d::UnitX();
    case ClipAxis::y: return Eigen::Vector3d::UnitY();
    case ClipAxis::z: return Eigen::Vector3d::UnitZ();
    case ClipAxis::view: break;
    }
    return clip.direction.normalized();
}

std::optional<HalfSpace> kept_by(const ClipPlane& clip)
{
    if (!clip.on)
        return std::nullopt;
    const double side = clip.flip ? 1 : -1;
    return HalfSpace{side * direction_of(clip), -side * clip.place_mm};
}

std::optional<KeptRay> kept_of_ray(const HalfSpace& half, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction)
{
    constexpr double endless = std::numeric_limits<double>::infinity();
    // height = start + slope t
    const double start = half.height(origin), slope = half.normal.dot(direction);
    if (slope == 0)
        return start >= 0 ? std::optional(KeptRay{0, endless}) : std::nullopt;
    const double meets = -start / slope;
    if (slope > 0)
        return KeptRay{std::max(0., meets), endless};
    return meets >= 0 ? std::optional(KeptRay{0, meets}) : std::nullopt;
}

Eigen::Vector3d kept_eye(const std::optional<HalfSpace>& half, const Eigen::Vector3d& eye, const Eigen::Vector3d& place)
{
    if (!half)
        return eye;
    const Eigen::Vector3d sight = place - eye;
    const auto seen = kept_of_ray(*half, eye, sight);
    return seen ? Eigen::Vector3d(eye + std::min(seen->from, 1.) * sight) : place;
}

} // namespace spia::viewer
