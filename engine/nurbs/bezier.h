#pragma once
#include <Eigen/Core>
#include <vector>

#include "engine/nurbs/surface.h"

namespace spia {

/// A polynomial in two parameters from 0 to 1 by its Bezier coefficients, each a vector. It lies
/// within their convex hull.
struct BezierPatch {
    int degree_s = 0, degree_t = 0;
    Eigen::MatrixXd coefficient; ///< dimension by (degree_s + 1) * (degree_t + 1), s fastest

    auto at(int i, int j) const { return coefficient.col(i + j * (degree_s + 1)); }
    auto at(int i, int j) { return coefficient.col(i + j * (degree_s + 1)); }
};

/// (w x, w y, w z, w) of a surface over the span that begins at knots_u[span_u], knots_v[span_v].
/// [blossoms; NURBS Book, 5.3]
BezierPatch bezier_of(const NurbsSurface& surface, int span_u, int span_v);

BezierPatch derivative_s(const BezierPatch& f);
BezierPatch derivative_t(const BezierPatch& f);

/// Sum and products of the same parameters, exact but for rounding.
/// @pre the same degrees and dimension
BezierPatch sum(const BezierPatch& f, const BezierPatch& g);
BezierPatch cross(const BezierPatch& f, const BezierPatch& g); ///< @pre three dimensions
/// @pre factor has one dimension
BezierPatch times(const BezierPatch& factor, const BezierPatch& g);
BezierPatch rows(const BezierPatch& f, int first, int count); ///< some of its components

/// The first or second half along s (0 to 1/2, 1/2 to 1), in parameters from 0 to 1 again. [de
/// Casteljau]
BezierPatch half_s(const BezierPatch& f, bool second);
BezierPatch half_t(const BezierPatch& f, bool second);

} // namespace spia
