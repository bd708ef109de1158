#pragma once
#include "app/viewer/views/scene_cache.h"

namespace spia::viewer {

/// A part that was refused, with a dot at each place that makes it so.
/// @param state  with state.refused
Scene refused_scene(const ViewerState& state, SceneCache& cache);

/// A ring and a text at the fault that is looked at; nothing if none is.
void add_shown_fault(Scene& scene, const ViewerState& state);

} // namespace spia::viewer
