#pragma once
#include "app/viewer/views/scene_cache.h"

/// What the scenes share and the cache keeps.
namespace spia::viewer {

/// @param state  with a part
const PartShape& part_shape(const ViewerState& state, SceneCache& cache);

/// The field of the display; null: none is chosen, or the session does not have it.
const FieldValues* field_values(const ViewerState& state, SceneCache& cache);

/// How that field is called and coloured. @param size of the part, mm
SceneLegend legend_of(const ViewerState& state, const FieldValues& values, double size);

/// Where the sheet of the part is drawn: formed or flat.
struct SheetPlace {
    std::shared_ptr<const SceneMesh> mesh;
    const Eigen::Matrix3Xd& position; ///< 3 by #V of the part, mm
    bool flat = false;                ///< not shaded
    bool converging = false;          ///< a shape so far: it has no values yet
    double mm_per_pixel = 1;          ///< of the view it is seen in
};

/// The sheet with all that is shown on it: field, isolines, regions, selection, the face under the
/// mouse, principal strains, watched places. Its layer comes first, its lines and labels last.
/// @param scene  with its box
/// @param state  with a part
void add_sheet(Scene& scene, const ViewerState& state, const SheetPlace& place, SheetCache& cache, SceneCache& shared);

std::shared_ptr<const FaceMarks> marks_of(const ViewerState& state, SceneCache& cache);

/// The selection and the face under the mouse as outlines on the part and the picked vertices, in
/// front of everything: for views whose faces are not those of the part.
void add_part_outlines(Scene& scene, const ViewerState& state, SceneCache& cache);

} // namespace spia::viewer
