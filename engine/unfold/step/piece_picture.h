#pragma once
#include <optional>

#include "engine/unfold/step/ring_chart.h"

namespace spia {

/// How a freed piece is told in the plane: by the development of its target, or where the hinge
/// goes all the way around, by a picture of it that is not cut.
struct PiecePicture {
    TargetSurface target; ///< its development whole around the hinge
    std::optional<RingChart> ring;
    Eigen::Matrix2Xd held; ///< 2 by #held, mm

    Eigen::Vector3d point(const Eigen::Vector2d& place) const
    {
        return ring ? ring->point(place) : placed(target, place);
    }
    bool true_lengths() const { return !ring && !std::holds_alternative<HeightFace>(target); }
    /// What makes them lengths around a triangle of the picture.
    Eigen::Matrix2d lengths(const Eigen::Matrix<double, 2, 3>& corner) const
    {
        return ring ? ring->lengths(corner) : metric(target, corner.rowwise().mean());
    }
};

/// @param now 3 by #V of the piece, mm: the state
/// @throws InputError if the piece closes a cylinder or cone
PiecePicture picture_of(const FreedPiece& piece, const Eigen::Matrix3Xd& now, const TargetSurface& target);

/// The development of a piece from its first held vertex on from edge to edge, see unwound().
std::optional<Eigen::Matrix2Xd> unwound_piece(const FreedPiece& piece, const Eigen::Matrix3Xd& now,
                                              const TargetSurface& target);

} // namespace spia
