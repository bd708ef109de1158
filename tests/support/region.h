#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

/// Regions of a parameter plane and their first triangulation.
namespace spia::shapes {

/// Where a surface is defined.
struct Region {
    /// Negative inside, zero on the boundary, positive outside; near the boundary about the
    /// distance to it, mm.
    std::function<double(const Eigen::Vector2d&)> distance;
    Eigen::Vector2d low, high;            ///< a box around it
    std::vector<Eigen::Vector2d> corners; ///< sharp turns of the boundary, where a vertex must lie
    double smallest_feature = 1e30;       ///< mm, radius of the smallest hole or rounding, width of
                                          ///< the narrowest bridge
};

/// @name Signed distances, negative inside
///@{
double box_distance(const Eigen::Vector2d& p, const Eigen::Vector2d& centre, const Eigen::Vector2d& half_size,
                    double corner_radius);
double capsule_distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius);
/// The region where both are negative, the corners between them rounded.
double rounded_intersection(double a, double b, double radius);
///@}

/// The nearest point with distance zero, by Newton steps along the gradient.
Eigen::Vector2d on_boundary_of(const Region& region, Eigen::Vector2d p);

struct Circle {
    Eigen::Vector2d centre;
    double radius; ///< mm

    /// negative inside
    double distance(const Eigen::Vector2d& p) const { return (p - centre).norm() - radius; }
};

/// A rectangle with round holes.
Region perforated(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const std::vector<Circle>& holes);

/// An upper limit of the edge length, mm: eight edges around each hole, growing with the distance
/// to it.
std::function<double(const Eigen::Vector2d&)> edges_around(const std::vector<Circle>& holes);

struct PlaneMesh {
    std::vector<Eigen::Vector2d> position;
    Eigen::Matrix3Xi triangle; ///< 3 by #F, counter-clockwise
    std::vector<int> corner;   ///< the vertex at each of the region's corners
};

/// A lattice of equilateral triangles, cut along the boundary of the region. Its triangles at the
/// boundary may be thin.
/// @param spacing  mm; below the smallest feature, or holes are lost
PlaneMesh cut_lattice(const Region& region, double spacing);

} // namespace spia::shapes
