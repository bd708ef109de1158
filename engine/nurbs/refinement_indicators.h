#pragma once
#include <vector>

#include "engine/nurbs/deviation.h"
#include "engine/nurbs/fit_patch.h"

namespace spia {

/// How urgently each span wants to be halved, mm: the largest distance beyond the tolerance that it
/// has a part in; 0: not at all. A place that is too far away asks for knots in the direction in
/// which least squares alone leaves most there; in both if it leaves about as much.
struct RefinementIndicators {
    std::vector<double> u, v; ///< per span
};

/// @param points  the data (i, j) of the fit at the parameters of along_u x along_v, i fastest
RefinementIndicators refinement_indicators(const NurbsSurface& surface, const std::vector<BeyondTolerance>& beyond,
                                           const Eigen::Matrix3Xd& points, const CurveFit& along_u,
                                           const CurveFit& along_v);

} // namespace spia
