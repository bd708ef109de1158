#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/core/progress.h"

namespace spia {

/// Triangles in the plane, each with the shape it would like to have.
struct PlanarElements {
    Eigen::Matrix3Xi triangle;             ///< 3 by #T; every vertex belongs to one
    std::vector<Eigen::Matrix2d> to_shape; ///< per triangle the inverse of its wanted edges (b - a,
                                           ///< c - a)
    Eigen::VectorXd weight;                ///< per triangle, of its energy in the sum
    Eigen::Matrix2Xi fixed;                ///< 2 by #V: 1 where a coordinate of a vertex stays
};

/// Draws a vertex to a place, with weight / 2 times the squared distance over the size of an
/// element.
struct Pull {
    int node = -1;
    Eigen::Vector2d target;
    double weight = 1;
};

struct UntangleElementsOptions {
    int most_steps = 100;      ///< Newton steps
    double area_weight = 0.05; ///< of equal areas against good shapes
    double element_area = 1;   ///< mm2, what pulls are measured by
    double thin = 0;           ///< elements are opened with eps > 0, like folded ones, while a
                               ///< determinant is not above this
};

/// Moves the free coordinates until every triangle turns the right way, and on to good shapes.
/// Minimises the weighted sum of ElementEnergy with eps brought to zero, by projected Newton steps.
/// Once every determinant is above `thin`, none falls to zero again.
/// @return the smallest determinant of the maps from the wanted shapes: not positive where a
/// triangle stays folded
double untangle_elements(Eigen::Matrix2Xd& position, const PlanarElements& elements, const std::vector<Pull>& pulls,
                         const UntangleElementsOptions& options, const Progress& progress = {});

} // namespace spia
