#pragma once
#include "app/viewer/model/document/scene.h"
#include "app/viewer/model/document/state.h"
#include "app/viewer/views/scene_cache.h"

/// What each of the four views shows. Cheap if nothing has changed since the last call with the
/// same cache.
namespace spia::viewer {

inline constexpr double usual_height = 600;

/// The part with the field, regions, selection, probes, least and greatest value and principal
/// strains.
/// @param pixels  height of the view at content scale 1: how dense the principal strains are
Scene part_scene(const ViewerState& state, SceneCache& cache, double pixels = usual_height);

/// The same on the flat blank, with its four corners (labels 1 to 4) and sides; while a job lays it
/// out, its shape so far. With the tool for corners, the lines of the grid; folded cells are red.
Scene blank_scene(const ViewerState& state, SceneCache& cache, double pixels = usual_height);

/// The quad mesh on the part, its cells coloured by the scaled Jacobian they have in the plane;
/// folded cells are red.
Scene quad_scene(const ViewerState& state, SceneCache& cache);

/// The NURBS surface, coloured by its distance from the part, with its control net where that
/// leaves the surface to be seen.
Scene surface_scene(const ViewerState& state, SceneCache& cache, double pixels = usual_height);

Scene scene(View view, const ViewerState& state, SceneCache& cache, double pixels = usual_height);

} // namespace spia::viewer
