#pragma once
#include "engine/nurbs/fit.h"

namespace spia {

/// Names what keeps a smooth surface away from the part near a place: the sharpest edge within
/// reach, or the sharpest corner of its border (not those of the surface itself), if one is sharper
/// than 5 degrees; else `otherwise`.
/// @param reach  mm around the place
/// @param left   mm, the deviation that is left
FitShortfall find_shortfall(const NurbsSurface& surface, const TriMesh& mesh, const FitOptions& options,
                            const Eigen::Vector3d& where, double reach, double left, FitShortfall::Reason otherwise);

} // namespace spia
