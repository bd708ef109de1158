#pragma once
#include <array>

#include "engine/core/progress.h"
#include "engine/mesh/tri_mesh.h"
#include "engine/nurbs/surface.h"

namespace spia {

/// A surface as triangles, counter-clockwise in the (u, v) plane.
struct Tessellation {
    TriMesh mesh;
    Eigen::Matrix2Xd uv;     ///< 2 by #V, parameters of the vertices
    Eigen::Matrix3Xd normal; ///< 3 by #V, unit, S_u x S_v; on a collapsed side its limit
};

/// Samples every span evenly, its borders included; two triangles per cell. Along a side collapsed
/// to a point, one of the two has no area.
/// @throws InputError  if samples_per_span < 1 or the surface has too many samples to be numbered
Tessellation tessellate(const NurbsSurface& surface, int samples_per_span = 4, const Progress& progress = {});

/// The same with so many samples along u and along v.
Tessellation tessellate(const NurbsSurface& surface, const std::array<int, 2>& samples_per_span,
                        const Progress& progress = {});

/// The distinct knots of one direction with samples_per_span - 1 even steps between every two of
/// them.
std::vector<double> sample_parameters(const std::vector<double>& knots, int degree, int samples_per_span);

} // namespace spia
