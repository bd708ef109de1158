#pragma once
#include <Eigen/Core>
#include <string_view>
#include <variant>

namespace spia {

// Faces in space on which sheet can be unfolded, each with a map to the plane, its development.
// That of a plane, a cylinder or a cone keeps all lengths; that of a smooth face is the view along
// the normal of a plane, and metric() tells its lengths. The axes are such that a triangle that is
// seen counter-clockwise from the outer side is so in the plane.

struct PlaneFace {
    Eigen::Vector3d origin;           ///< mm; of the development, too
    Eigen::Matrix<double, 3, 2> axes; ///< orthonormal; their cross product points to the outer side

    friend bool operator==(const PlaneFace&, const PlaneFace&) = default;
};

struct CylinderFace {
    Eigen::Vector3d origin;  ///< mm, on the axis
    Eigen::Vector3d axis;    ///< unit vector
    Eigen::Vector3d towards; ///< unit vector square to the axis, to the middle of the face:
                             ///< opposite of it the development is cut
    double radius;           ///< mm
    bool bulges;             ///< the outer side looks away from the axis

    friend bool operator==(const CylinderFace&, const CylinderFace&) = default;
};

struct ConeFace {
    Eigen::Vector3d apex;    ///< mm
    Eigen::Vector3d axis;    ///< unit vector from the apex into the cone
    Eigen::Vector3d towards; ///< as of a cylinder
    double half_angle;       ///< radians, between axis and generators
    bool bulges;

    friend bool operator==(const ConeFace&, const ConeFace&) = default;
};

/// A smooth height over a plane: a bicubic spline on even knots, and where these end straight on.
struct HeightFace {
    Eigen::Vector3d origin;           ///< mm, of the plane and of the development
    Eigen::Matrix<double, 3, 2> axes; ///< as of a plane
    Eigen::Vector2d corner;           ///< mm, in the plane: the first knot of either way
    double spacing;                   ///< mm, of the knots
    Eigen::MatrixXd coefficient;      ///< mm, of the B-splines; 3 more than cells in x (rows) and y
                                      ///< (columns)

    friend bool operator==(const HeightFace& a, const HeightFace& b);
};

using TargetSurface = std::variant<PlaneFace, CylinderFace, ConeFace, HeightFace>;
std::string_view name(const TargetSurface& face);

/// The place of the face that is nearest to a point in space, in the development. mm; of a smooth
/// face the one above or below it
Eigen::Vector2d developed(const TargetSurface& face, const Eigen::Vector3d& point);
/// The point in space of a place of the development. mm
Eigen::Vector3d placed(const TargetSurface& face, const Eigen::Vector2d& place);
/// The unit normal on the outer side, where the face is nearest to the point.
Eigen::Vector3d outer_normal(const TargetSurface& face, const Eigen::Vector3d& point);
/// The derivative of placed() by the place: ways of the development in space. On a smooth face they
/// are not of unit length.
Eigen::Matrix<double, 3, 2> tangents(const TargetSurface& face, const Eigen::Vector2d& place);
/// The lengths of the face around a place of its development: M = sqrt(J^T J), J the derivative of
/// placed(); a small way d of the development is |M d| long. The identity, but on a smooth face.
Eigen::Matrix2d metric(const TargetSurface& face, const Eigen::Vector2d& place);

} // namespace spia
