#pragma once
#include <optional>

#include "engine/unfold/step/freed_piece.h"
#include "engine/unfold/target/target_surface.h"

namespace spia {

/// Where a ring of sheet goes all the way around a cylinder or a cone its development would have to
/// be cut. This picture of the face is not: it is conformal, w = exp(i z) of a development z that
/// is told in radii, so the ring is a ring of the plane around the origin. It keeps no lengths;
/// those of the development are taken triangle by triangle.
class RingChart {
public:
    /// @param state 3 by #V of the piece, mm: its hinge keeps its size in the picture, and the
    /// piece is outside of it
    /// @returns none if the face is neither cylinder nor cone
    static std::optional<RingChart> around(const TargetSurface& face, const FreedPiece& piece,
                                           const Eigen::Matrix3Xd& state);

    /// mm, of the nearest point of the face
    Eigen::Vector2d place(const Eigen::Vector3d& point) const;
    Eigen::Vector3d point(const Eigen::Vector2d& place) const; ///< mm

    /// Corners of a triangle in a development that is whole around it. mm
    Eigen::Matrix<double, 2, 3> developed(const Eigen::Matrix<double, 2, 3>& corner) const;

    /// What makes the triangle of the picture that of the development, but for its rotation:
    /// symmetric. Where that is turned over (an arc of the picture can bulge through a thin
    /// triangle) the lengths at the middle.
    Eigen::Matrix2d lengths(const Eigen::Matrix<double, 2, 3>& corner) const;

    /// mm, in the picture: how far a band of some area reaches from the hinge on.
    double radius_of(double area_mm2) const;

private:
    Eigen::Vector3d origin_, axis_, towards_;
    double sine_;   ///< of the cone's half angle; 0: a cylinder
    double radius_; ///< mm, of the face at the hinge and of the hinge in the picture
    double level_;  ///< mm, of the hinge along the generators, from a cone's apex
    double side_;   ///< 1: the outer side looks away from the axis; -1: to it
    double way_;    ///< 1: the piece lies where places along the generators grow; -1: where they
                    ///< fall
};

} // namespace spia
