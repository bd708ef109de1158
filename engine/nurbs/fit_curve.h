#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "engine/nurbs/curve_ends.h"

namespace spia {

/// The points of a curve at parameters that rise from 0 to 1. 3 by #parameters, mm
using CurveSource = std::function<Eigen::Matrix3Xd(const std::vector<double>& parameters)>;

struct CurveFitOptions {
    double tolerance = 0.1; ///< mm, distance of the curve from its points, across its direction
    int degree = 3;         ///< 2 to 5
    CurveEnds ends = CurveEnds::averaged_knots;
    int most_spans = 4096;
    std::vector<double> lines = {}; ///< the only parameters at which the source is known; empty:
                                    ///< any
};

struct CurveFitResult {
    std::vector<double> borders; ///< of the spans
    std::vector<double> knots;
    Eigen::Matrix3Xd control; ///< mm
    double largest = 0;       ///< mm, distance from the points, across the curve's direction
    int rounds = 0;
    bool reached = false; ///< else the spans or the data ran out: the closest curve is given
};

/// A least squares curve through the first and last point of its source. The spans in which it is
/// farther from the source than the tolerance are halved until none is left; all knots are dyadic,
/// see span_borders.h.
/// @throws InputError if the tolerance or the degree is out of range, or the source gives something
/// else than points
CurveFitResult fit_curve(const CurveSource& source, const CurveFitOptions& options = {});

/// The least squares curve over given spans, e.g. those that the two neighbours of a curve have in
/// common.
CurveFitResult curve_over(const std::vector<double>& borders, const CurveSource& source,
                          const CurveFitOptions& options = {});

} // namespace spia
