#pragma once
#include <Eigen/Core>
#include <optional>

namespace spia::viewer {

/// Across which direction a clipping plane lies.
enum class ClipAxis { x, y, z, view };

/// A plane that cuts away what hides the inside.
struct ClipPlane {
    bool on = false;
    ClipAxis axis = ClipAxis::x;
    double place_mm = 0;                ///< of the plane along its direction, from the origin
    bool flip = false;                  ///< the lower side goes, else the upper one
    Eigen::Vector3d direction{0, 0, 1}; ///< unit, of ClipAxis::view: towards the viewer when it was
                                        ///< chosen

    friend bool operator==(const ClipPlane&, const ClipPlane&) = default;
};

/// Unit vector square to the plane.
Eigen::Vector3d direction_of(const ClipPlane& clip);

/// What is kept: normal.x + offset >= 0.
struct HalfSpace {
    Eigen::Vector3d normal{0, 0, 1}; ///< unit
    double offset = 0;               ///< mm

    /// mm, above 0: kept
    double height(const Eigen::Vector3d& place) const { return normal.dot(place) + offset; }
    friend bool operator==(const HalfSpace&, const HalfSpace&) = default;
};

/// Nothing where nothing is cut away.
std::optional<HalfSpace> kept_by(const ClipPlane& clip);

/// The part of a ray that is kept: from how far to how far along it, in lengths of its direction.
struct KeptRay {
    double from = 0, to = 0;
};
/// Nothing where none of it is kept.
std::optional<KeptRay> kept_of_ray(const HalfSpace& half, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction);

/// From where an eye sees a place that is kept: itself, or where its line of sight comes through
/// the plane.
Eigen::Vector3d kept_eye(const std::optional<HalfSpace>& half, const Eigen::Vector3d& eye,
                         const Eigen::Vector3d& place);

} // namespace spia::viewer
