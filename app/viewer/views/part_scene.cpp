#include "app/viewer/views/marking.h"
#include "app/viewer/views/picked_vertices.h"
#include "app/viewer/views/scene_mesh.h"
#include "app/viewer/views/sheet_shapes.h"
#include "app/viewer/views/strain_glyphs.h"
#include "app/viewer/views/views.h"

namespace spia::viewer {

Scene part_scene(const ViewerState& state, SceneCache& cache)
{
    Scene result;
    const Session& session = state.document.session;
    if (!session.part) {
        result.empty = "Drop a part here or open one: STL, OBJ, PLY, OFF, glTF.";
        return result;
    }
    const PartShape& part = part_shape(state, cache);
    const FieldDisplay& display = state.document.display;
    result.box = part.box;
    result.region_colours = region_colours(state.document.regions);

    SceneLayer sheet;
    sheet.mesh = part.mesh;
    sheet.marks = marks_of(state, cache);
    sheet.edges = state.view.edges;
    sheet.features = state.view.features;
    const FieldValues* const values = field_values(state, cache);
    if (values) {
        result.legend = legend_of(state, *values);
        sheet.scale = result.legend->scale;
        sheet.field = cache.field_on_part.of(
            {part.mesh, session.part, session.blank, session.surface, display.field, display.per_face},
            [&] { return scene_field(*part.mesh, values->value, display.per_face); });
    }
    result.layers.push_back(std::move(sheet));

    const auto add = [&](const LineList& lines) {
        result.lines.insert(result.lines.end(), lines.begin(), lines.end());
    };
    if (display.directions && session.blank)
        add(cache.glyphs_on_part.of({session.part, session.blank}, [&] {
            return strain_glyphs(session.part->mesh, *session.blank, session.part->mesh.position);
        }));
    add(cache.selection_on_part.of({part.mesh, state.document.selected},
                                   [&] { return outline_of_faces(*part.mesh, state.document.selected, 1.5f, false); }));
    add(cache.hover_on_part.of({part.mesh, state.hovered}, [&] {
        return state.hovered ? outline_of_faces(*part.mesh, {*state.hovered}, 2, false) : LineList{};
    }));
    add_watched_places(result, state, values, session.part->mesh.position);
    add_picked_vertices(result, state, cache.vertices_on_part, part.mesh, session.part->mesh.position);
    return result;
}

Scene scene(View view, const ViewerState& state, SceneCache& cache)
{
    switch (view) {
    case View::part: return part_scene(state, cache);
    case View::blank: return blank_scene(state, cache);
    case View::quads: return quad_scene(state, cache);
    case View::surface: return surface_scene(state, cache);
    }
    return {};
}

} // namespace spia::viewer
