#pragma once
#include "app/viewer/views/scene_cache.h"

/// What the scenes share and the cache keeps.
namespace spia::viewer {

/// @param state  with a part
const PartShape& part_shape(const ViewerState& state, SceneCache& cache);

/// The field of the display; null: none is chosen, or the session does not have it.
const FieldValues* field_values(const ViewerState& state, SceneCache& cache);

/// How that field is called and coloured.
SceneLegend legend_of(const ViewerState& state, const FieldValues& values);

std::shared_ptr<const FaceMarks> marks_of(const ViewerState& state, SceneCache& cache);

/// The selection and the face under the mouse as outlines on the part and the picked vertices, in front of everything: for views whose faces
/// are not those of the part.
void add_part_outlines(Scene& scene, const ViewerState& state, SceneCache& cache);

} // namespace spia::viewer
