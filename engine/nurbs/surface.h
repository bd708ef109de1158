#pragma once
#include <Eigen/Core>
#include <vector>

namespace spia {

/// A NURBS surface with clamped knot vectors; control point (i, j) is column i + j * count_u (u
/// fastest).
struct NurbsSurface {
    int degree_u = 3, degree_v = 3;
    int count_u = 0, count_v = 0; ///< control points along u and v
    std::vector<double> knots_u;  ///< count_u + degree_u + 1 values with repetition, from 0 to 1
    std::vector<double> knots_v;  ///< count_v + degree_v + 1 values
    Eigen::Matrix3Xd control;     ///< 3 by count_u * count_v, mm, Cartesian (not multiplied by the
                                  ///< weight)
    Eigen::VectorXd weight;       ///< count_u * count_v, all 1 for a polynomial surface

    int index(int i, int j) const { return i + j * count_u; }
};

} // namespace spia
