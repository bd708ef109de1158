#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace spia::viewer {

/// Points of a plane, counted in the squares of a grid: how a diagram shows more points than it has
/// room for.
struct PointCloud {
    struct Square {
        int column, row;    ///< from the least x and y on
        int points, marked; ///< how many lie in it, and of these the marked ones; points > 0
    };
    std::vector<Square> squares; ///< row by row
    int most = 0;                ///< points of the fullest square
};

/// @param x,y,marked of the points, one each; marked: not 0
/// @param range      what the grid covers; points outside are not counted, those on its edge are
PointCloud count_points(const Eigen::VectorXd& x, const Eigen::VectorXd& y, const Eigen::VectorXi& marked,
                        const Eigen::AlignedBox2d& range, int columns, int rows);

/// The point nearest to a place, in a plane whose axes have scales of their own.
/// @param reach along either axis, what counts as the same distance; farther off there is none
std::optional<int> nearest_point(const Eigen::VectorXd& x, const Eigen::VectorXd& y, const Eigen::Vector2d& at,
                                 const Eigen::Vector2d& reach);

/// Ascending; those on the edge are within.
std::vector<int> points_within(const Eigen::VectorXd& x, const Eigen::VectorXd& y, const Eigen::AlignedBox2d& box);

} // namespace spia::viewer
