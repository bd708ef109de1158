#pragma once
#include <vector>

#include "engine/coons/quad_grid.h"
#include "engine/core/progress.h"
#include "engine/nurbs/curve_ends.h"
#include "engine/nurbs/surface.h"

namespace spia {

struct InterpolateOptions {
    /// What the degrees of freedom beyond the data are used for. Averaged knots leave none: the
    /// knots are means of the parameters, with as many control points as nodes; order degree + 1 up
    /// to the border. Clamped and natural ends take two control points more than nodes in each
    /// direction. Natural ones, as in the paper (4.4.4), have a knot at every node, are cubic, and
    /// the fourth mixed derivative is zero at the corners.
    using Ends = CurveEnds;
    /// How far apart in parameter two neighbouring rows of nodes lie.
    enum class Parameters {
        chord,       ///< by their distance: even speed; for smooth parts
        centripetal, ///< by the square root of their distance: calmer at sharp turns
        uniform      ///< evenly: keeps the parameters of the grid of the blank
    };
    Ends ends = Ends::averaged_knots;
    Parameters parameters = Parameters::chord;
    int degree_u = 3, degree_v = 3; ///< 2 to 5; nodes - 1 where a direction has too few

    friend bool operator==(const InterpolateOptions&, const InterpolateOptions&) = default;
};

struct InterpolateResult {
    NurbsSurface surface;  ///< all weights 1
    std::vector<double> u; ///< columns + 1 parameters rising from 0 to 1: node (i, j) of the grid
                           ///< is S(u[i], v[j])
    std::vector<double> v; ///< rows + 1 parameters
    /// Neighbouring columns (rows) of nodes that coincide, or nearly so: their parameters were held
    /// apart so that the surface exists, but it stands still between them and has no normal there.
    /// 0 for a good grid.
    int coinciding_columns = 0, coinciding_rows = 0;
};

/// The surface through all nodes of the grid, by one sweep of banded systems along each direction;
/// the matrix is factored once per direction. Parameters are the means over all rows (columns) of
/// the grid; a row that is collapsed to a point has no say. [Zhu2013, eq. 26 and 4.4.4; NURBS Book,
/// eqs. 9.5 to 9.8, 9.4.1]
/// @param lifted  at least one column and one row of cells
/// @param progress  one checkpoint per sweep
/// @throws InputError if the grid is empty, its size and nodes disagree, a coordinate is not a
/// number, or the
///                     degree is not offered with these ends
InterpolateResult interpolate(const QuadGrid& lifted, const InterpolateOptions& options = {},
                              const Progress& progress = {});

} // namespace spia
