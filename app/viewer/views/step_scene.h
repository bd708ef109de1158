#pragma once
#include "app/viewer/views/scene_cache.h"

namespace spia::viewer {

/// Whether the view of the part shows it by its steps: one is chosen, or the part is unfolded by
/// some.
bool shows_steps(const ViewerState& state);

/// The part as far as the slider has unfolded it: of the chosen step the faces that carry yellow,
/// those it moves green, its target (also before it is run) a translucent patch around where they
/// come to lie; or the field of the state.
/// @param state  with a part
Scene step_scene(const ViewerState& state, SceneCache& cache);

/// A small picture of a step: the part after it, or if it is not run after the last one before that
/// is; what carries it yellow, what it moves green, from where that is best seen before and after
/// (best_turn()).
struct StepPicture {
    std::shared_ptr<const PartFile> part; ///< with the next three: what it is of
    std::shared_ptr<const StepsRun> run;
    std::shared_ptr<const PlannedStep> step;
    size_t after = 0; ///< so many steps
    Scene scene;
    Camera camera;
};
/// Makes the picture anew if it is of something else. @param size pixels
void follow(StepPicture& picture, const ViewerState& state, SceneCache& cache, size_t number, glm::dvec2 size);

/// A patch of a face in space around some places of it, with a margin. mm
/// @param beyond_mm so much farther to all sides
TriMesh target_patch(const TargetSurface& face, const Eigen::Matrix3Xd& places, double beyond_mm = 0);

/// The same without a margin: just so much farther to all sides.
TriMesh patch_around(const TargetSurface& face, const Eigen::Matrix3Xd& places, double beyond_mm);

} // namespace spia::viewer
