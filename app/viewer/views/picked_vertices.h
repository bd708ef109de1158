#pragma once
#include "app/viewer/views/scene_cache.h"

namespace spia::viewer {

/// Dots at the picked vertices, with their numbers in the file while they are few, between two of
/// them a line with its length, and a ring around the vertex that a click would pick.
/// @param sheet what is drawn; @param position 3 by #V of the part, mm: on the part or flat
void add_picked_vertices(Scene& scene, const ViewerState& state, SceneCache::Vertices& cache,
                         const std::shared_ptr<const SceneMesh>& sheet, const Eigen::Matrix3Xd& position);

} // namespace spia::viewer
