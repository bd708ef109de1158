#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

/// Curves of DXF files as chords. Points are in the unit of the file.
namespace spia::dxf {

using Points = std::vector<Eigen::Vector3d>;

/// Of a circle: the first point with it, the last not. Chords stay within 2e-5 of the radius.
/// @param turn radians, either way
void add_arc(const Eigen::Vector3d& centre, double radius, double from, double turn, Points& points);

/// The way from a to b, without b. @param bulge tangent of a quarter of its angle; 0: straight
void add_way(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double bulge, Points& points);

/// From one parameter to another, both ends with it. @param major half the major axis @param ratio
/// of the minor to it
/// @param to radians, above from
Points ellipse(const Eigen::Vector3d& centre, const Eigen::Vector3d& major, double ratio, double from, double to);

/// A B-spline as its file gives it.
struct Spline {
    int degree = 3;
    std::vector<double> knots;
    Points poles;
    std::vector<double> weights; ///< none: all 1
};

/// Chords within 2e-5 of the curve's extent, from end to end of its domain [NURBS Book, algorithm
/// A4.1 by de Boor's scheme].
/// @returns none if the numbers make no spline: a count that does not fit, knots that fall, a
/// weight that is not positive
std::optional<Points> chords_of(const Spline& spline);

} // namespace spia::dxf
