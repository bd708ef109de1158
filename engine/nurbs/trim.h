#pragma once
#include <string>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/nurbs/surface.h"

namespace spia {

/// A polynomial curve in the parameters of a surface, its knots clamped from 0 to 1.
struct PlaneCurve {
    int degree = 1;
    std::vector<double> knots;
    Eigen::Matrix2Xd control; ///< (u, v)
};

Eigen::Vector2d evaluate(const PlaneCurve& curve, double t);

/// The border of a hole in a surface: curves end to end and closed, the surface on their left
/// (clockwise in u, v).
using TrimLoop = std::vector<PlaneCurve>;

struct TrimOptions {
    double tolerance = 0.01; ///< mm, of a smooth curve from the vertices of the hole, measured on
                             ///< the surface
    double corner = 0.7;     ///< radians: where the border turns by more, one curve ends and the
                             ///< next begins
};

/// A hole that no curve was made of.
struct HoleLeftFilled {
    int vertex = -1; ///< of the part, the first of its border
    std::string why; ///< e.g. "its border crosses itself on the surface"
};

struct TrimResult {
    std::vector<TrimLoop> loop; ///< of the holes, as boundary_loops() has them
    double distance = 0;        ///< mm, the largest from a vertex of a hole to its curve's point on
                                ///< the surface
    std::vector<HoleLeftFilled> left_filled;
};

/// The holes of a part as curves in the parameters of a surface that covers them. The vertices of a
/// hole's border are projected on the surface; between corners a least squares cubic goes through
/// them within the tolerance, else straight lines in (u, v) from foot to foot. A border that is
/// pinched to a point becomes a loop on either side of it, 0.001 mm before it. Loops that reach the
/// border of the surface, cross themselves or others are left out (exact test of 8 chords per
/// span); they may touch.
/// @param outer  a vertex of the part on the border of the surface: its loop is no hole
/// @throws InputError  if an option is not positive
TrimResult trim_holes(const TriMesh& part, int outer, const NurbsSurface& surface, const TrimOptions& options = {},
                      const Progress& progress = {});

} // namespace spia
