#pragma once
#include <Eigen/Geometry>
#include <glm/glm.hpp>
#include <limits>

#include "app/viewer/model/picking/camera.h"

namespace spia::viewer {

/// A rectangle of pixels.
struct PixelBox {
    glm::dvec2 least{std::numeric_limits<double>::infinity()}, greatest{-std::numeric_limits<double>::infinity()};

    bool holds(glm::dvec2 p) const
    {
        return p.x >= least.x && p.y >= least.y && p.x <= greatest.x && p.y <= greatest.y;
    }
};

/// A view of a mesh, prepared for many places.
class Sight {
public:
    Sight(const Camera& camera, const Eigen::AlignedBox3d& box, glm::dvec2 size)
        : size_(size), perspective_(camera.perspective)
    {
        const glm::dmat4 view = view_matrix(camera, Eigen::Vector3d::Zero());
        const glm::dmat4 to_clip = projection_matrix(camera, size.x / size.y, box) * view;
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 4; ++k)
                to_clip_(i, k) = to_clip[k][i];
        const glm::dvec4 eye = glm::inverse(view)[3];
        eye_ = {eye.x, eye.y, eye.z};
        const Ray middle = ray_through(camera, box, size / 2., size);
        direction_ = middle.direction;
        near_ = (middle.origin - eye_).dot(direction_);
    }

    /// NaN before the near plane
    glm::dvec2 pixel(const Eigen::Vector3d& place) const
    {
        const Eigen::Vector4d clip = to_clip_ * place.homogeneous();
        if (!(clip[2] >= -clip[3]))
            return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
        return {(clip[0] / clip[3] + 1) / 2 * size_.x, (1 - clip[1] / clip[3]) / 2 * size_.y};
    }

    /// Where the line of sight to a place comes through the near plane.
    Eigen::Vector3d viewer_of(const Eigen::Vector3d& place) const
    {
        const double depth = (place - eye_).dot(direction_);
        if (!perspective_)
            return place - (depth - near_) * direction_;
        return eye_ + near_ / depth * (place - eye_);
    }

    /// The planes around what the view shows in a rectangle, for RayPicker::near().
    Eigen::Matrix<double, 4, 5> half_spaces(const PixelBox& box) const
    {
        const Eigen::RowVector4d x = to_clip_.row(0), y = to_clip_.row(1), z = to_clip_.row(2), w = to_clip_.row(3);
        const auto across = [&](double pixel) { return 2 * pixel / size_.x - 1; };
        const auto up = [&](double pixel) { return 1 - 2 * pixel / size_.y; };
        Eigen::Matrix<double, 5, 4> result;
        result << x - across(box.least.x) * w, across(box.greatest.x) * w - x, y - up(box.greatest.y) * w,
            up(box.least.y) * w - y, z + w;
        return result.transpose();
    }

private:
    Eigen::Matrix4d to_clip_;
    Eigen::Vector3d eye_, direction_;
    double near_;
    glm::dvec2 size_;
    bool perspective_;
};

} // namespace spia::viewer
