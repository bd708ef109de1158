#pragma once
#include <Eigen/Core>
#include <vector>

namespace spia {

/// A cubic B-spline in the plane, clamped. With two poles it is the straight line between them.
struct SmoothSpline {
    std::vector<double> knots; ///< by the lengths of the chords
    std::vector<Eigen::Vector2d> poles;
};

/// Cubic splines through all points of a line, a new one from every corner on (a turn of more than
/// 30 degrees). Between corners the tangent is continuous: that of the parabola through a point and
/// its neighbours [Bessel; de Boor, A Practical Guide to Splines, ch. IV], so that a point moves
/// the curve beside itself only.
/// @param points two or more, no two running ones at one place
/// @param closed from the last back to the first
std::vector<SmoothSpline> smooth_splines(const Eigen::Matrix2Xd& points, bool closed);

} // namespace spia
