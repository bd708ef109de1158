#include "app/viewer/model/picking/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <tuple>

namespace spia::viewer {
namespace {

constexpr double half_angle = 15 * std::numbers::pi / 180; ///< of the perspective, upwards
const double slope = std::tan(half_angle);                 ///< of its upper side

/// mm, between an atom's neighbourhood and a country
constexpr double least_height = 1e-6, greatest_height = 1e9;
constexpr double margin = 1.06; ///< of fit(), on each side 3 %

glm::dvec3 to_glm(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d to_eigen(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// From the target to the eye, mm. The orthographic eye stands there too, so both see the target at
/// the same size.
double eye_distance(const Camera& camera) { return camera.height / (2 * slope); }

std::array<glm::dvec3, 8> corners(const Eigen::AlignedBox3d& box)
{
    std::array<glm::dvec3, 8> result;
    for (int i = 0; i < 8; ++i)
        result[size_t(i)] = to_glm(box.corner(Eigen::AlignedBox3d::CornerType(i)));
    return result;
}

struct DepthRange {
    double near, far; ///< mm in front of the eye; the orthographic near may lie behind it
};

DepthRange depth_range(const Camera& camera, const Eigen::AlignedBox3d& box)
{
    const double distance = eye_distance(camera);
    const glm::dvec3 backwards = glm::mat3_cast(camera.turn)[2];
    double near = distance, far = distance;
    if (!box.isEmpty())
        for (const glm::dvec3& corner : corners(box)) {
            const double depth = distance - glm::dot(corner - camera.target, backwards);
            near = std::min(near, depth);
            far = std::max(far, depth);
        }
    // A flat box, and lines that are drawn a little in front of what they lie on, need some room.
    const double room = 0.01 * (far - near) + 0.01 * camera.height;
    near -= room;
    far += room;
    // A near plane at the eye would leave no depth buffer for the rest. A box around the eye is cut
    // there instead.
    if (camera.perspective)
        near = std::max(near, distance / 20);
    return {near, far};
}

/// From the middle of the view, right and up, mm at the depth of the target.
glm::dvec2 at_target(const Camera& camera, glm::dvec2 pixel, glm::dvec2 size)
{
    const double mm_per_pixel = camera.height / size.y;
    return {(pixel.x - size.x / 2) * mm_per_pixel, (size.y / 2 - pixel.y) * mm_per_pixel};
}

/// @param axes columns: right, up and towards the viewer in space
glm::dquat turn_of(const glm::dvec3& right, const glm::dvec3& up)
{
    return glm::normalize(glm::quat_cast(glm::dmat3(right, up, glm::cross(right, up))));
}

} // namespace

glm::dmat4 view_matrix(const Camera& camera, const Eigen::Vector3d& origin)
{
    const glm::dmat4 turned = glm::mat4_cast(glm::conjugate(camera.turn));
    const glm::dmat4 moved = glm::translate(glm::dmat4(1), to_glm(origin) - camera.target);
    return glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -eye_distance(camera))) * turned * moved;
}

glm::dmat4 projection_matrix(const Camera& camera, double aspect, const Eigen::AlignedBox3d& box)
{
    const auto [near, far] = depth_range(camera, box);
    if (camera.perspective)
        return glm::perspective(2 * half_angle, aspect, near, far);
    const double up = camera.height / 2, right = up * aspect;
    return glm::ortho(-right, right, -up, up, near, far);
}

Ray ray_through(const Camera& camera, const Eigen::AlignedBox3d& box, glm::dvec2 pixel, glm::dvec2 size)
{
    const glm::dmat3 axes = glm::mat3_cast(camera.turn);
    const double distance = eye_distance(camera), near = depth_range(camera, box).near;
    const glm::dvec2 aside = at_target(camera, pixel, size);
    // in the camera's axes, from the target
    glm::dvec3 from(aside, distance - near), direction(0, 0, -1);
    if (camera.perspective) {
        from = glm::dvec3(aside * (near / distance), distance - near);
        direction = glm::normalize(glm::dvec3(aside, -distance));
    }
    return {to_eigen(camera.target + axes * from), to_eigen(axes * direction)};
}

glm::dvec3 pixel_of(const Camera& camera, const Eigen::Vector3d& place, glm::dvec2 size)
{
    const glm::dvec3 seen = glm::conjugate(camera.turn) * (to_glm(place) - camera.target);
    double pixels_per_mm = size.y / camera.height;
    if (camera.perspective) {
        const double distance = eye_distance(camera), ahead = distance - seen.z;
        if (!(ahead > 0))
            return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
        pixels_per_mm *= distance / ahead;
    }
    return {size.x / 2 + seen.x * pixels_per_mm, size.y / 2 - seen.y * pixels_per_mm, seen.z};
}

Eigen::Vector3d place_beside(const Camera& camera, const Eigen::Vector3d& place, glm::dvec2 pixels, glm::dvec2 size)
{
    double mm_per_pixel = camera.height / size.y;
    if (camera.perspective) {
        const glm::dvec3 seen = glm::conjugate(camera.turn) * (to_glm(place) - camera.target);
        mm_per_pixel *= std::max(eye_distance(camera) - seen.z, 0.) / eye_distance(camera);
    }
    const glm::dvec3 way = camera.turn * glm::dvec3(pixels.x * mm_per_pixel, -pixels.y * mm_per_pixel, 0);
    return place + Eigen::Vector3d(way.x, way.y, way.z);
}

Camera orbit(Camera camera, glm::dvec2 drag, glm::dvec2 size)
{
    if (camera.flat)
        return pan(camera, drag, size);
    const double length = glm::length(drag);
    if (!(length > 0))
        return camera;
    // Half a turn for a drag across the shorter side. What is in front goes with the mouse.
    const double angle = std::numbers::pi * length / std::min(size.x, size.y);
    const glm::dvec3 axis(drag.y / length, drag.x / length, 0);
    camera.turn = glm::normalize(camera.turn * glm::angleAxis(-angle, axis));
    return camera;
}

Camera pan(Camera camera, glm::dvec2 drag, glm::dvec2 size)
{
    const double mm_per_pixel = camera.height / size.y;
    camera.target -= camera.turn * glm::dvec3(drag.x * mm_per_pixel, -drag.y * mm_per_pixel, 0);
    return camera;
}

Camera zoom(Camera camera, double factor, glm::dvec2 pixel, glm::dvec2 size)
{
    // In perspective the eye moves along the ray through the pixel, so all that is under it stays
    // there.
    const glm::dvec2 before = at_target(camera, pixel, size);
    camera.height = std::clamp(camera.height / factor, least_height, greatest_height);
    camera.target += camera.turn * glm::dvec3(before - at_target(camera, pixel, size), 0);
    return camera;
}

Camera fit(Camera camera, const Eigen::AlignedBox3d& box, double aspect)
{
    if (box.isEmpty())
        return camera;
    Eigen::Matrix3Xd corner(3, 8);
    for (int i = 0; i < 8; ++i)
        corner.col(i) = box.corner(Eigen::AlignedBox3d::CornerType(i));
    const double across = 0.5 * (1 - 1 / margin) * aspect, upwards = 0.5 * (1 - 1 / margin);
    return fit(camera, corner, {aspect, 1}, {across, across, upwards, upwards});
}

Camera fit(Camera camera, const Eigen::Matrix3Xd& point, glm::dvec2 size, Margins margins)
{
    if (point.cols() == 0)
        return camera;
    constexpr double most = 0.6; // of the view is left free
    for (const auto& [one, other, whole] :
         {std::tuple(&margins.left, &margins.right, size.x), {&margins.top, &margins.bottom, size.y}})
        if (const double sum = *one + *other; sum > most * whole) {
            *one *= most * whole / sum;
            *other *= most * whole / sum;
        }
    const glm::dvec3 low = to_glm(point.rowwise().minCoeff()), high = to_glm(point.rowwise().maxCoeff()),
                     middle = (low + high) / 2.;
    const glm::dquat into_view = glm::conjugate(camera.turn);
    // The view's upper side is at `slope` from the line of sight, the borders of what is filled at
    // these. A place (x, y, z) from the middle is within them if x - a <= right * (d - z) and so
    // on, with the eye at (a, b, d). The tightest two sides give the least d, and a. In an
    // orthographic view the depth does not matter.
    const glm::dvec2 greater = 2 * slope / size.y * (size / 2. - glm::dvec2(margins.right, margins.top)),
                     less = 2 * slope / size.y * (size / 2. - glm::dvec2(margins.left, margins.bottom));
    glm::dvec2 most_up(-std::numeric_limits<double>::infinity()), most_down = most_up;
    for (Eigen::Index i = 0; i < point.cols(); ++i) {
        const glm::dvec3 seen = into_view * (to_glm(point.col(i)) - middle);
        const double depth = camera.perspective ? seen.z : 0;
        most_up = glm::max(most_up, glm::dvec2(seen) + greater * depth);
        most_down = glm::max(most_down, -glm::dvec2(seen) + less * depth);
    }
    const glm::dvec2 least_distance = (most_up + most_down) / (greater + less);
    const double height = 2 * slope * std::max(least_distance.x, least_distance.y);
    // a line seen from its end, a point
    const double least = std::max(1e-3 * glm::length(high - low), least_height);
    camera.height = std::clamp(height, least, greatest_height);
    const double distance = eye_distance(camera);
    const glm::dvec2 centre = (most_up - greater * distance - most_down + less * distance) / 2.;
    camera.target = middle + camera.turn * glm::dvec3(centre, 0);
    return camera;
}

Camera between(const Camera& from, const Camera& to, double share)
{
    Camera camera = to;
    camera.target = glm::mix(from.target, to.target, share);
    camera.turn = glm::normalize(glm::slerp(from.turn, to.turn, share));
    camera.height = from.height * std::pow(to.height / from.height, share);
    return camera;
}

Camera look(Camera camera, StandardView view)
{
    const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    if (camera.flat)
        view = StandardView::top;
    switch (view) {
    case StandardView::top: camera.turn = turn_of(x, y); break;
    case StandardView::bottom: camera.turn = turn_of(x, -y); break;
    case StandardView::front: camera.turn = turn_of(x, z); break;
    case StandardView::back: camera.turn = turn_of(-x, z); break;
    case StandardView::left: camera.turn = turn_of(-y, z); break;
    case StandardView::right: camera.turn = turn_of(y, z); break;
    case StandardView::isometric: { // from the front right above
        const glm::dvec3 right = glm::normalize(x + y), viewer = glm::normalize(x - y + z);
        camera.turn = turn_of(right, glm::cross(viewer, right));
        break;
    }
    }
    return camera;
}

} // namespace spia::viewer
