#include "app/viewer/views/step_scene.h"

#include <algorithm>
#include <cmath>

#include "app/viewer/model/document/step_target.h"
#include "app/viewer/views/best_view.h"
#include "app/viewer/views/fault_scene.h"
#include "app/viewer/views/isolines.h"
#include "app/viewer/views/marking.h"
#include "app/viewer/views/palette.h"
#include "app/viewer/views/picked_vertices.h"
#include "app/viewer/views/scene_mesh.h"
#include "app/viewer/views/sheet_shapes.h"
#include "engine/core/error.h"
#include "engine/mesh/topology.h"

namespace spia::viewer {
namespace {

/// The mesh of the part with its vertices at other places; edges, and which of them are sharp, stay
/// those of the part.
SceneMesh moved(const SceneMesh& part, const Eigen::Matrix3Xd& position)
{
    SceneMesh result = part;
    result.origin = (position.rowwise().minCoeff() + position.rowwise().maxCoeff()) / 2;
    result.position.leftCols(position.cols()) = (position.colwise() - result.origin).cast<float>();
    for (size_t i = 0; i < part.repeated.size(); ++i)
        result.position.col(position.cols() + Eigen::Index(i)) = result.position.col(part.repeated[i]);
    result.normal.setZero();
    for (const auto corners : result.triangle.colwise()) {
        const Eigen::Vector3f a = result.position.col(corners[0]), b = result.position.col(corners[1]),
                              c = result.position.col(corners[2]);
        for (const uint32_t v : corners)
            result.normal.col(v) += (b - a).cross(c - a);
    }
    result.normal.colwise().normalize();
    return result;
}

const UnfoldedShape& shape_of(const ViewerState& state, SceneCache& cache)
{
    const auto& mesh = part_shape(state, cache).mesh;
    const double position = step_position(state);
    return cache.steps.shape.of({mesh, state.document.unfolding, position}, [&] {
        const Eigen::Matrix3Xd place = unfolded_places(state.document, position);
        if (position == 0)
            return UnfoldedShape{mesh, place};
        return UnfoldedShape{std::make_shared<SceneMesh>(moved(*mesh, place)), place};
    });
}

Eigen::AlignedBox3d box_of(const ViewerState& state, SceneCache& cache)
{
    const PartShape& part = part_shape(state, cache);
    if (step_position(state) == 0)
        return part.box;
    const size_t done = steps_done(state.document);
    return cache.steps.box.of({part.mesh, state.document.unfolding, done}, [&] {
        Eigen::AlignedBox3d box = part.box;
        for (size_t k = 0; k < done; ++k) {
            const Eigen::Matrix3Xd& place = state.document.unfolding->run.states[k].position;
            box.extend(Eigen::AlignedBox3d(place.rowwise().minCoeff(), place.rowwise().maxCoeff()));
        }
        return box;
    });
}

std::shared_ptr<const PlannedStep> chosen_step(const ViewerState& state)
{
    return step_shown(state) ? state.document.steps[size_t(*state.view.step)] : nullptr;
}

std::vector<FaceRegion> picks_of(const PlannedStep& step)
{
    std::vector<FaceRegion> picks{{"unfolds", RegionKind::other, palette::freed, step.pick.freed}};
    if (!step.pick.fixed.empty())
        picks.push_back({"stays", RegionKind::fixed, palette::fixed, carrying_faces(step)});
    return picks;
}

Eigen::AlignedBox2d developed_box(const TargetSurface& face, const Eigen::Matrix3Xd& places)
{
    Eigen::AlignedBox2d box;
    for (const auto place : places.colwise())
        box.extend(developed(face, place));
    return box;
}

std::vector<int> vertices_of(const Eigen::Matrix3Xi& triangle, const std::vector<int>& faces)
{
    std::vector<char> used(size_t(triangle.maxCoeff()) + 1, 0);
    for (const int f : faces)
        for (const int v : triangle.col(f))
            used[size_t(v)] = 1;
    std::vector<int> vertex;
    for (size_t v = 0; v < used.size(); ++v)
        if (used[v])
            vertex.push_back(int(v));
    return vertex;
}

/// A target that ends: a patch around what carries it.
TriMesh ended_patch(const TargetSurface& face, const TriMesh& before, const PlannedStep& step)
{
    const std::vector<int> carrying = vertices_of(before.triangle, carrying_faces(step));
    return patch_around(face, before.position(Eigen::all, carrying), *step.extent_mm);
}

/// The face on which a step will lay its faces, as far as that is known before; null: it is fitted
/// to a smooth one, or there is none.
std::shared_ptr<const SceneMesh> target_to_be(const TriMesh& before, const PlannedStep& step)
{
    if (!step.pick.target && step.kind != UnfoldKind::lay)
        return nullptr;
    try {
        const std::optional<TargetSurface> face = planned_target(before, step);
        if (!face)
            return nullptr;
        if (step.extent_mm)
            return std::make_shared<SceneMesh>(scene_mesh(ended_patch(*face, before, step)));
        const Eigen::Matrix3Xd freed = before.position(Eigen::all, vertices_of(before.triangle, step.pick.freed));
        double height = 0; // so far it may come to lie from where it stands now
        for (const auto x : freed.colwise())
            height = std::max(height, (x - placed(*face, developed(*face, x))).norm());
        return std::make_shared<SceneMesh>(scene_mesh(target_patch(*face, freed, height)));
    } catch (const InputError&) { // running the step says what is wrong with it
        return nullptr;
    }
}

/// The face on which the chosen step has laid its faces or will; null: it has none.
std::shared_ptr<const SceneMesh> target_of(const ViewerState& state, const PlannedStep& step, SceneCache& cache)
{
    const auto number = size_t(*state.view.step);
    const size_t done = steps_done(state.document);
    const auto& run = state.document.unfolding;
    if (number >= done) {
        if (number > done && !step.pick.target) // what carries it may still move
            return nullptr;
        return cache.steps.target_to_be.of(
            {part_shape(state, cache).mesh, run, state.document.steps[number], done}, [&] {
                return target_to_be(
                    {unfolded_places(state.document, double(done)), state.document.session.part->mesh.triangle}, step);
            });
    }
    return cache.steps.target.of({run, number}, [&]() -> std::shared_ptr<const SceneMesh> {
        const UnfoldState& after = run->run.states[number];
        if (!after.on)
            return nullptr;
        if (step.extent_mm)
            return std::make_shared<SceneMesh>(
                scene_mesh(ended_patch(after.on->face, {after.position, run->part->mesh.triangle}, step)));
        return std::make_shared<SceneMesh>(scene_mesh(target_patch(
            after.on->face, after.position(Eigen::all, vertices_of(run->part->mesh.triangle, step.pick.freed)))));
    });
}

/// The field of the state that is shown, or towards which the part is on its way. Null: none is.
const FieldValues* values_of(const ViewerState& state, SceneCache& cache)
{
    const FieldDisplay& display = state.document.display;
    const double position = step_position(state);
    if (!state.view.field_on_steps || position == 0 || !available_in_steps(display.field))
        return nullptr;
    const auto number = size_t(std::ceil(position)) - 1;
    const auto& run = state.document.unfolding;
    return &cache.steps.values.of({run, number, display.field, by_face(display)}, [&] {
        const TriMesh& part = run->part->mesh;
        const SheetFields& face = run->run.states[number].face;
        return FieldValues{values(part, face, display.field, by_face(display)), face_values(part, face, display.field)};
    });
}

void colour_by_field(Scene& scene, SceneLayer& sheet, const ViewerState& state, const FieldValues& values,
                     SceneCache& cache)
{
    const FieldDisplay& display = state.document.display;
    const auto number = size_t(std::ceil(step_position(state))) - 1;
    scene.legend = legend_of(state, values, part_shape(state, cache).box.diagonal().norm());
    sheet.scale = scene.legend->scale;
    sheet.field = cache.steps.field.of({sheet.mesh, state.document.unfolding, number, display.field, by_face(display)},
                                       [&] { return scene_field(*sheet.mesh, values.drawn, by_face(display)); });
}

} // namespace

bool shows_steps(const ViewerState& state) { return step_shown(state) || step_position(state) > 0; }

void follow(StepPicture& picture, const ViewerState& state, SceneCache& cache, size_t number, glm::dvec2 size)
{
    const Document& document = state.document;
    const auto& step = document.steps[number];
    const size_t after = std::min(number + 1, steps_done(document));
    if (picture.part == document.session.part && picture.run == document.unfolding && picture.step == step &&
        picture.after == after)
        return;
    picture = {document.session.part, document.unfolding, step, after, {}, {}};
    const auto& mesh = part_shape(state, cache).mesh;
    const Eigen::Matrix3Xd place = unfolded_places(document, double(after));
    const std::vector<FaceRegion> picks = picks_of(*step);
    SceneLayer sheet;
    sheet.mesh = after == 0 ? mesh : std::make_shared<SceneMesh>(moved(*mesh, place));
    sheet.marks = face_marks(int(mesh->triangle.cols()), {}, picks);
    picture.scene.region_colours = region_colours(picks);
    picture.scene.layers.push_back(std::move(sheet));
    picture.scene.box = Eigen::AlignedBox3d(place.rowwise().minCoeff(), place.rowwise().maxCoeff());
    constexpr double around = 2; // pixels
    std::vector<Eigen::Matrix3Xd> states{place};
    if (after == number + 1)
        states.push_back(unfolded_places(document, double(number)));
    Camera camera;
    camera.turn = best_turn(document.session.part->mesh.triangle, states, step->pick.freed);
    picture.camera = fit(camera, place, size, {around, around, around, around});
}

TriMesh target_patch(const TargetSurface& face, const Eigen::Matrix3Xd& places, double beyond_mm)
{
    constexpr double margin = 0.08; // of the diagonal of what lies on it
    const double size = developed_box(face, places).diagonal().norm();
    return patch_around(face, places, beyond_mm + margin * (size + beyond_mm));
}

TriMesh patch_around(const TargetSurface& face, const Eigen::Matrix3Xd& places, double beyond_mm)
{
    constexpr int cells = 40;
    const Eigen::AlignedBox2d box = developed_box(face, places);
    const Eigen::Vector2d from = box.min().array() - beyond_mm,
                          step = (box.sizes().array() + 2 * beyond_mm) / double(cells);
    TriMesh patch{Eigen::Matrix3Xd(3, (cells + 1) * (cells + 1)), Eigen::Matrix3Xi(3, 2 * cells * cells)};
    int next = 0;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i)
            patch.position.col(j * (cells + 1) + i) = placed(face, from + step.cwiseProduct(Eigen::Vector2d(i, j)));
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const int a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
            patch.triangle.col(next++) << a, b, d;
            patch.triangle.col(next++) << a, d, c;
        }
    return patch;
}

Scene step_scene(const ViewerState& state, SceneCache& cache)
{
    Scene scene;
    const Document& document = state.document;
    const UnfoldedShape& shape = shape_of(state, cache);
    const auto chosen = chosen_step(state);
    scene.box = box_of(state, cache);
    const FieldValues* const values = values_of(state, cache);

    SceneLayer sheet;
    sheet.mesh = shape.mesh;
    sheet.edges = state.view.edges;
    sheet.features = state.view.features;
    static const std::vector<FaceRegion> nothing;
    const std::vector<FaceRegion>& picks =
        chosen ? cache.steps.picks.of({chosen}, [&] { return picks_of(*chosen); }) : nothing;
    scene.region_colours = region_colours(picks);
    sheet.marks = cache.steps.marks.of({part_shape(state, cache).mesh, chosen, document.selected}, [&] {
        return face_marks(int(shape.mesh->triangle.cols()), document.selected, picks);
    });
    if (values)
        colour_by_field(scene, sheet, state, *values, cache);
    scene.layers.push_back(std::move(sheet));
    if (chosen)
        if (const auto target = target_of(state, *chosen, cache)) {
            SceneLayer patch;
            patch.mesh = target;
            patch.colour = patch.back = palette::target;
            scene.layers.push_back(std::move(patch));
        }

    const auto add = [&](const LineList& lines) { scene.lines.insert(scene.lines.end(), lines.begin(), lines.end()); };
    add(cache.steps.borders.of({shape.mesh, chosen}, [&] { return region_borders(*shape.mesh, picks); }));
    add(cache.steps.selection.of({shape.mesh, document.selected},
                                 [&] { return outline_of_faces(*shape.mesh, document.selected, 1.5f, false); }));
    add_hovered(scene, state, shape.position);
    add_watched_places(scene, state, values, shape.position);
    const auto& labels = cache.steps.labels.of({shape.mesh, chosen, state.view.dark}, [&] {
        return region_labels(document.session.part->mesh.triangle, shape.position, picks, state.view.dark);
    });
    scene.labels.insert(scene.labels.end(), labels.begin(), labels.end());
    add_picked_vertices(scene, state, cache.steps.vertices, shape.mesh, shape.position);
    add_shown_fault(scene, state);
    return scene;
}

} // namespace spia::viewer
