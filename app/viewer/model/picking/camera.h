#pragma once
#include <Eigen/Geometry>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string_view>

namespace spia::viewer {

enum class StandardView { top, bottom, front, back, left, right, isometric };

/// Looks at a target from a distance. Lengths in mm; a view's pixels run right and down from its
/// upper left corner.
struct Camera {
    glm::dvec3 target{0, 0, 0};
    glm::dquat turn{1, 0, 0, 0}; ///< camera axes (x right, y up, z towards the viewer) into space
    double height = 100;         ///< mm, what the view shows from bottom to top at the target
    bool perspective = false;    ///< with a vertical angle of 30 degrees, else orthographic
    bool flat = false;           ///< of a flat drawing: it is not turned out of its plane

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// Space (relative to `origin`, so that single precision is enough) to clip coordinates, of a view
/// of this aspect (width / height). Near and far enclose `box`.
glm::dmat4 view_matrix(const Camera& camera, const Eigen::Vector3d& origin);
glm::dmat4 projection_matrix(const Camera& camera, double aspect, const Eigen::AlignedBox3d& box);

struct Ray {
    Eigen::Vector3d origin, direction; ///< mm, unit
};

/// Through a pixel of a view of this size, from in front of everything in the box (in perspective,
/// of all of it that is shown: what lies between the eye and the near plane is not).
Ray ray_through(const Camera& camera, const Eigen::AlignedBox3d& box, glm::dvec2 pixel, glm::dvec2 size);

/// Pixel of a place, and its depth towards the viewer: mm, 0 at the target, larger is nearer. In
/// perspective a place beside or behind the eye has no pixel: all three are NaN.
glm::dvec3 pixel_of(const Camera& camera, const Eigen::Vector3d& place, glm::dvec2 size);

/// Where a place gets to that moves by so many pixels in the plane of the picture; in perspective
/// as much as its depth asks for.
Eigen::Vector3d place_beside(const Camera& camera, const Eigen::Vector3d& place, glm::dvec2 pixels, glm::dvec2 size);

/// Turns by a drag from one pixel to another: left and right about the vertical of the picture, up
/// and down about its horizontal. A flat camera pans instead.
Camera orbit(Camera camera, glm::dvec2 drag, glm::dvec2 size);
/// What was under the mouse follows it.
Camera pan(Camera camera, glm::dvec2 drag, glm::dvec2 size);
/// Larger than 1 comes nearer; the place under the pixel stays there.
Camera zoom(Camera camera, double factor, glm::dvec2 pixel, glm::dvec2 size);
/// Shows the whole box with a small margin, without turning.
Camera fit(Camera camera, const Eigen::AlignedBox3d& box, double aspect);
/// What stays free on each side of a view, pixels; less in a view that has no room for it.
struct Margins {
    double left = 0, right = 0, top = 0, bottom = 0;

    friend bool operator==(const Margins&, const Margins&) = default;
};
/// Shows all points, as large as the margins allow, without turning. @param point 3 by #points, mm
Camera fit(Camera camera, const Eigen::Matrix3Xd& point, glm::dvec2 size, Margins margins);
/// On the way from one camera to another: 0 is the first, 1 the second. Turns by the shortest way,
/// and grows evenly for the eye.
Camera between(const Camera& from, const Camera& to, double share);
/// Turns to a standard view about the target.
Camera look(Camera camera, StandardView view);

} // namespace spia::viewer
