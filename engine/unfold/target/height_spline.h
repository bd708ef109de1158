#pragma once
#include <Eigen/Core>

#include "engine/unfold/target/target_surface.h"

namespace spia {

struct Height {
    double value;          ///< mm
    Eigen::Vector2d slope; ///< its derivative
};

/// Of a place of the face's development.
Height height_at(const HeightFace& face, const Eigen::Vector2d& place);

/// The B-splines of one cell of even knots and their derivatives by the cell's share t, 0 to 1. [de
/// Boor 1978]
struct CellSplines {
    Eigen::Vector4d value, first, second;
};
CellSplines cell_splines(double t);

} // namespace spia
