#pragma once
#include "app/viewer/model/document/scene.h"
#include "app/viewer/model/document/state.h"
#include "app/viewer/views/scene_cache.h"

namespace spia::viewer {

/// What was measured in a view: its lines, and labels "M1  12.30 mm".
void add_measurements(Scene& scene, const ViewerState& state, View view, SceneCache& cache);

} // namespace spia::viewer
