#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "engine/layout/simplify/arc.h"

namespace spia {

/// One side of a four-sided face, in its direction around the face: straight, or a piece of an arc.
struct QuadSide {
    const Arc* arc = nullptr; ///< nullptr: straight
    double from = 0, to = 0;  ///< mm along the arc; from > to where it is run through backwards

    double length(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const
    {
        return arc ? std::abs(to - from) : (b - a).norm();
    }
};

struct Quad {
    std::array<Eigen::Vector2d, 4> corner; ///< counter-clockwise
    std::array<QuadSide, 4> side;          ///< k from corner k to corner k + 1
};

struct QuadQuality {
    double least = 0; ///< scaled Jacobian
    int cells = 0;    ///< that were looked at
};

/// The least scaled Jacobian (sine of the angle of a cell at a corner, 1: right) of the Coons grid
/// between the sides; at most that of the straight quad times 1.5 plus 0.1, which keeps faces from
/// curling up. Negative: the grid is folded.
/// @param cells  along each side; more are added at kinks of arcs
QuadQuality quad_quality(const Quad& quad, int cells);

/// Whether two sides of a quad have more than their common corner in common. Exact but for the
/// places of corners within segments of arcs.
bool sides_cross(const Quad& quad);

/// Mean length of two opposite sides over that of the other two, 1 or more.
double quad_aspect(const Quad& quad);

/// What a face costs: one for being there, more the worse its shape; `good` is the quality from
/// which on a face is not dearer for its worst corner.
double quad_energy(double quality, double aspect, double good);

} // namespace spia
