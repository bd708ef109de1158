#include "app/viewer/views/sheet_shapes.h"

#include <cmath>

#include "app/viewer/model/reports/comparison.h"
#include "app/viewer/views/colour_scale.h"
#include "app/viewer/views/isolines.h"
#include "app/viewer/views/marking.h"
#include "app/viewer/views/palette.h"
#include "app/viewer/views/picked_vertices.h"
#include "app/viewer/views/process_lines.h"
#include "app/viewer/views/scene_mesh.h"
#include "app/viewer/views/strain_glyphs.h"

namespace spia::viewer {
const PartShape& part_shape(const ViewerState& state, SceneCache& cache)
{
    const auto& part = state.document.session.part;
    return cache.part.of({part}, [&] {
        const TriMesh& mesh = part->mesh;
        const Eigen::AlignedBox3d box(mesh.position.rowwise().minCoeff(), mesh.position.rowwise().maxCoeff());
        return PartShape{std::make_shared<SceneMesh>(scene_mesh(mesh)), box, boundary_edges(mesh)};
    });
}

const FieldValues* field_values(const ViewerState& state, SceneCache& cache)
{
    const Session& session = state.document.session;
    const FieldDisplay& display = state.document.display;
    if (display.field == Field::none || !session.part || !available(session, display.field))
        return nullptr;
    return &cache.values.of(
        {session.part, blank_of_field(state), session.limits, session.surface, display.field, by_face(display)}, [&] {
            const Session shown = session_of_field(state);
            return FieldValues{values(shown, display.field, by_face(display)), face_values(shown, display.field)};
        });
}

SceneLegend legend_of(const ViewerState& state, const FieldValues& values, double size)
{
    const FieldInfo& field = info(state.document.display.field);
    const std::array<double, 2> extremes = values.said.extremes();
    const ShownUnit as = as_shown(field.unit, state.preferences.lengths);
    SceneLegend legend{label_of_field(state), field.field == Field::zone ? std::string() : as.unit,
                       field_scale(state.document.display, extremes, size, as.factor)};
    legend.below = below(legend.scale, extremes[0]);
    legend.above = above(legend.scale, extremes[1]);
    legend.note = noise_note(state.document.display, extremes, size, as.factor);
    if (is_smoothed(state.document.display))
        legend.note += legend.note.empty() ? "contour smoothed" : ", smoothed";
    return legend;
}

std::shared_ptr<const FaceMarks> marks_of(const ViewerState& state, SceneCache& cache)
{
    const Document& document = state.document;
    return cache.marks.of({document.session.part, document.selected, document.regions}, [&] {
        return face_marks(document.session.part->mesh.triangles(), document.selected, document.regions);
    });
}

void add_sheet(Scene& scene, const ViewerState& state, const SheetPlace& place, SheetCache& cache, SceneCache& shared)
{
    const Document& document = state.document;
    const Session& session = document.session;
    const FieldDisplay& display = document.display;
    const TriMesh& part = session.part->mesh;
    const auto& mesh = place.mesh;
    scene.region_colours = region_colours(document.regions);

    SceneLayer sheet;
    sheet.mesh = mesh;
    sheet.marks = marks_of(state, shared);
    sheet.edges = state.view.edges;
    sheet.features = state.view.features;
    sheet.lit = !place.flat;
    const FieldValues* const values = place.converging ? nullptr : field_values(state, shared);
    if (values) {
        scene.legend = legend_of(state, *values, part_shape(state, shared).box.diagonal().norm());
        sheet.scale = scene.legend->scale;
        sheet.field = cache.field.of({mesh, session.part, blank_of_field(state), session.limits, session.surface,
                                      display.field, by_face(display)},
                                     [&] { return scene_field(*mesh, values->drawn, by_face(display)); });
        if (display.isolines && !by_face(display))
            scene.isolines =
                cache.isolines.of({sheet.field, sheet.scale.least, sheet.scale.greatest, sheet.scale.ticks}, [&] {
                    return std::make_shared<const std::vector<Isoline>>(
                        isolines(place.position, part.triangle, values->drawn, tick_values(sheet.scale)));
                });
    }
    scene.layers.insert(scene.layers.begin(), std::move(sheet));

    const auto add = [&](const LineList& lines) { scene.lines.insert(scene.lines.end(), lines.begin(), lines.end()); };
    add(cache.regions.of({mesh, document.regions}, [&] { return region_borders(*mesh, document.regions); }));
    if (display.directions && session.blank && !place.converging) {
        const double spacing = glyph_spacing(place.mm_per_pixel, scene.box.diagonal().norm());
        add(cache.glyphs.of({session.part, session.blank, spacing},
                            [&] { return strain_glyphs(part, *session.blank, place.position, spacing); }));
    }
    add(cache.selection.of({mesh, document.selected},
                           [&] { return outline_of_faces(*mesh, document.selected, 1.5f, false); }));
    add_hovered(scene, state, place.position);
    if (place.converging)
        return;
    add_watched_places(scene, state, values, place.position);
    add_process_lines(scene, state, place.position, mesh, cache, shared);
    const auto& names =
        cache.region_labels.of({mesh, document.regions, state.view.dark, state.preferences.lengths}, [&] {
            return region_labels(part.triangle, place.position, document.regions, state.view.dark,
                                 state.preferences.lengths);
        });
    scene.labels.insert(scene.labels.end(), names.begin(), names.end());
}

void add_part_outlines(Scene& scene, const ViewerState& state, SceneCache& cache)
{
    const auto& mesh = part_shape(state, cache).mesh;
    const auto& selected = state.document.selected;
    const LineList& selection = cache.selection_elsewhere.of(
        {mesh, selected}, [&] { return outline_of_faces(*mesh, selected, 2, true, palette::selected); });
    scene.lines.insert(scene.lines.end(), selection.begin(), selection.end());
    add_hovered(scene, state, state.document.session.part->mesh.position);
    add_spot(scene, state, state.document.session.part->mesh.position);
    add_picked_vertices(scene, state, cache.vertices_on_part, mesh, state.document.session.part->mesh.position);
}

} // namespace spia::viewer
