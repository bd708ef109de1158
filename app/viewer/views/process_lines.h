#pragma once
#include "app/viewer/views/scene_cache.h"

/// Drawbeads and pilots on the sheet.
namespace spia::viewer {

/// Places along each line on the part, close enough together to follow it.
/// @return per line; empty for one that does not lie on the part as the solver wants it, see
/// LineOnPart
std::vector<std::vector<ClosestPoint>> places_of_lines(const TriMesh& part, const std::vector<ProcessLine>& lines);

/// The lines and pins with their names and forces.
/// @param position 3 by #V of the part, mm: on the part or flat
void add_process_lines(Scene& scene, const ViewerState& state, const Eigen::Matrix3Xd& position,
                       const std::shared_ptr<const SceneMesh>& mesh, SheetCache& cache, SceneCache& shared);

} // namespace spia::viewer
