#pragma once
#include <vector>

#include "engine/nurbs/fit.h"
#include "engine/nurbs/fit_patch.h"

namespace spia {

/// One least squares fit: its data, its two directions and its surface.
struct Attempt {
    std::vector<double> borders_u, borders_v; ///< of the spans
    Eigen::Matrix3Xd points;
    CurveFit along_u, along_v;
    NurbsSurface surface;
};

/// Border curves first, then the surface that holds them.
Attempt attempt(const FitSource& source, const FitOptions& options, const std::vector<double>& borders_u,
                const std::vector<double>& borders_v, const Progress& progress = {});

/// The surface over the same knots for other points, which are not kept.
void fit_to(Attempt& fit, const Eigen::Matrix3Xd& points, const Progress& progress = {});

} // namespace spia
