#pragma once
#include <Eigen/Core>
#include <string_view>
#include <variant>

namespace spia {

// Faces in space on which sheet can be unfolded without strain, each with its development: a map to the plane that keeps all lengths.
// Its axes are such that a triangle that is seen counter-clockwise from the outer side is so in the plane.

struct PlaneFace {
    Eigen::Vector3d origin;           ///< mm; of the development, too
    Eigen::Matrix<double, 3, 2> axes; ///< orthonormal; their cross product points to the outer side
};

struct CylinderFace {
    Eigen::Vector3d origin; ///< mm, on the axis
    Eigen::Vector3d axis;   ///< unit vector
    Eigen::Vector3d
        towards;   ///< unit vector square to the axis, to the middle of the face: opposite of it the development is cut
    double radius; ///< mm
    bool bulges;   ///< the outer side looks away from the axis
};

struct ConeFace {
    Eigen::Vector3d apex;    ///< mm
    Eigen::Vector3d axis;    ///< unit vector from the apex into the cone
    Eigen::Vector3d towards; ///< as of a cylinder
    double half_angle;       ///< radians, between axis and generators
    bool bulges;
};

using BinderFace = std::variant<PlaneFace, CylinderFace, ConeFace>;
std::string_view name(const BinderFace& face);

/// The place of the face that is nearest to a point in space, in the development. mm
Eigen::Vector2d developed(const BinderFace& face, const Eigen::Vector3d& point);
/// The point in space of a place of the development. mm
Eigen::Vector3d placed(const BinderFace& face, const Eigen::Vector2d& place);
/// The unit normal on the outer side, where the face is nearest to the point.
Eigen::Vector3d outer_normal(const BinderFace& face, const Eigen::Vector3d& point);

} // namespace spia
