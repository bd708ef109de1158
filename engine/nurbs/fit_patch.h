#pragma once
#include <array>

#include "engine/core/progress.h"
#include "engine/nurbs/curve_fit.h"
#include "engine/nurbs/surface.h"

namespace spia {

/// Control points of the border curves of a patch, v = 0, u = 1, v = 1, u = 0, each in the order of
/// its rising parameter.
using PatchBorders = std::array<Eigen::Matrix3Xd, 4>;

/// The least squares curves of the border points, over the knots of the patch.
/// @param points  (i, j) at parameter i of along_u and j of along_v, i fastest, mm
PatchBorders fit_borders(const Eigen::Matrix3Xd& points, const CurveFit& along_u, const CurveFit& along_v);

/// The tensor product least squares surface with given border curves, which it keeps bit for bit:
/// two sweeps of banded systems. Weights 1.
/// @throws InputError if the number of points or border control points is wrong, a coordinate is
/// not a number, or two
///                     borders do not meet in a corner to the last bit
NurbsSurface fit_patch(Eigen::Matrix3Xd points, const CurveFit& along_u, const CurveFit& along_v,
                       const PatchBorders& borders, const Progress& progress = {});

/// What least squares along u alone (v alone) leaves of the points, mm: in which direction knots
/// are missing.
struct DirectionResiduals {
    Eigen::Matrix3Xd u, v; ///< per point, as these are numbered
};
DirectionResiduals direction_residuals(const Eigen::Matrix3Xd& points, const CurveFit& along_u,
                                       const CurveFit& along_v);

} // namespace spia
