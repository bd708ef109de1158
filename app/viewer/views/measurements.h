#pragma once
#include "app/viewer/model/scene.h"
#include "app/viewer/model/state.h"
#include "app/viewer/views/scene_cache.h"

namespace spia::viewer {

/// What was measured on the part: its lines, and labels "M1  12.30 mm".
void add_measurements(Scene& scene, const ViewerState& state, SceneCache& cache);

} // namespace spia::viewer
