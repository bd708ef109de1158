#include "app/viewer/views/sheet_shapes.h"

#include <cmath>

#include "app/viewer/views/colour_scale.h"
#include "app/viewer/views/marking.h"
#include "app/viewer/views/palette.h"
#include "app/viewer/views/picked_vertices.h"
#include "app/viewer/views/scene_mesh.h"

namespace spia::viewer {
namespace {

FieldValues with_extremes(Eigen::VectorXd value)
{
    FieldValues result{std::move(value)};
    const auto number = [&](int i) { return std::isfinite(result.value[i]); };
    for (int i = 0; i < result.value.size(); ++i) {
        if (number(i) && (result.least < 0 || result.value[i] < result.value[result.least]))
            result.least = i;
        if (number(i) && (result.greatest < 0 || result.value[i] > result.value[result.greatest]))
            result.greatest = i;
    }
    return result;
}

} // namespace

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
    return &cache.values.of({session.part, session.blank, session.surface, display.field, display.per_face},
                            [&] { return with_extremes(values(session, display.field, display.per_face)); });
}

SceneLegend legend_of(const ViewerState& state, const FieldValues& values)
{
    const FieldInfo& field = info(state.document.display.field);
    return {std::string(field.label), std::string(field.unit), field_scale(state.document.display, values.extremes())};
}

std::shared_ptr<const FaceMarks> marks_of(const ViewerState& state, SceneCache& cache)
{
    const Document& document = state.document;
    return cache.marks.of({document.session.part, document.selected, document.regions, state.hovered}, [&] {
        return face_marks(document.session.part->mesh.triangles(), document.selected, document.regions, state.hovered);
    });
}

void add_part_outlines(Scene& scene, const ViewerState& state, SceneCache& cache)
{
    const auto& mesh = part_shape(state, cache).mesh;
    const auto& selected = state.document.selected;
    const LineList& selection = cache.selection_elsewhere.of(
        {mesh, selected}, [&] { return outline_of_faces(*mesh, selected, 2, true, palette::selected); });
    const LineList& hover = cache.hover_elsewhere.of({mesh, state.hovered}, [&] {
        return state.hovered ? outline_of_faces(*mesh, {*state.hovered}, 2.5f, true) : LineList{};
    });
    for (const LineList* lines : {&selection, &hover})
        scene.lines.insert(scene.lines.end(), lines->begin(), lines->end());
    add_picked_vertices(scene, state, cache.vertices_on_part, mesh, state.document.session.part->mesh.position);
}

} // namespace spia::viewer
