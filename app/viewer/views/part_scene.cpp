#include "app/viewer/views/fault_scene.h"
#include "app/viewer/views/measurements.h"
#include "app/viewer/views/picked_vertices.h"
#include "app/viewer/views/sheet_shapes.h"
#include "app/viewer/views/step_scene.h"
#include "app/viewer/views/views.h"
#include "engine/exchange/part_formats.h"

namespace spia::viewer {

Scene part_scene(const ViewerState& state, SceneCache& cache, double pixels)
{
    Scene result;
    const Session& session = state.document.session;
    if (state.refused && (!session.part || shows_refused(state))) {
        result = refused_scene(state, cache);
        add_shown_fault(result, state);
        return result;
    }
    if (!session.part) {
        result.empty = "Drop a part here or open one: " + part_format_names() + ".";
        return result;
    }
    if (shows_steps(state))
        return step_scene(state, cache);
    const PartShape& part = part_shape(state, cache);
    result.box = part.box;
    add_sheet(result, state,
              {.mesh = part.mesh,
               .position = session.part->mesh.position,
               .mm_per_pixel = state.view.camera[size_t(View::part)].height / pixels},
              cache.on_part, cache);
    add_picked_vertices(result, state, cache.vertices_on_part, part.mesh, session.part->mesh.position);
    add_measurements(result, state, View::part, cache);
    add_shown_fault(result, state);
    return result;
}

static Scene whole_scene(View view, const ViewerState& state, SceneCache& cache, double pixels)
{
    switch (view) {
    case View::part: return part_scene(state, cache, pixels);
    case View::blank: return blank_scene(state, cache, pixels);
    case View::quads: return quad_scene(state, cache);
    case View::surface: return surface_scene(state, cache, pixels);
    }
    return {};
}

Scene scene(View view, const ViewerState& state, SceneCache& cache, double pixels)
{
    Scene result = whole_scene(view, state, cache, pixels);
    result.kept = kept_in(state.view, view);
    return result;
}

} // namespace spia::viewer
