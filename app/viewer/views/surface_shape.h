#pragma once
#include "app/viewer/views/scene_cache.h"
#include "engine/mesh/fill_holes.h"
#include "engine/nurbs/tessellate.h"

namespace spia::viewer {

/// Distance of every vertex of the surface from the part, mm: positive where it lies on the outer side; not a number
/// where a hole of the part was filled, for there is nothing to keep to.
Eigen::VectorXd surface_deviation(const Tessellation& surface, const FilledMesh& part);

/// The surface in triangles.
/// @param part  what it stands for; null: it is not coloured
StageShape surface_shape(const NurbsSurface& surface, const FilledMesh* part);

/// Lines and points of the control net.
StageShape control_net_shape(const NurbsSurface& surface, bool dark);

} // namespace spia::viewer
