#include <algorithm>
#include <fmt/core.h>
#include <iterator>

#include "app/viewer/model/picking/handles.h"
#include "app/viewer/model/reports/lights.h"
#include "app/viewer/views/colour_scale.h"
#include "app/viewer/views/measurements.h"
#include "app/viewer/views/palette.h"
#include "app/viewer/views/scene_mesh.h"
#include "app/viewer/views/sheet_shapes.h"
#include "app/viewer/views/surface_shape.h"
#include "app/viewer/views/views.h"

namespace spia::viewer {
namespace {

/// That of the fit; a surface without one is held against what is usual.
double shown_tolerance(const SurfaceStage& surface) { return surface.fit ? surface.fit->tolerance : usual_tolerance; }

SceneLegend legend_of(SurfaceLook look, const SurfaceStage& surface, const SceneLayer& layer, double size,
                      LengthUnit lengths)
{
    SceneLegend legend;
    legend.scale = layer.scale;
    legend.unit = as_shown(unit_of(look), lengths).unit;
    const Eigen::VectorXf& value = layer.field->value;
    const auto finite = value.array().isNaN().select(0, value.array());
    legend.below = value.size() > 0 && below(layer.scale, finite.minCoeff());
    legend.above = value.size() > 0 && above(layer.scale, finite.maxCoeff());
    switch (look) {
    case SurfaceLook::mean_curvature: legend.title = "Mean curvature"; return legend;
    case SurfaceLook::gaussian_curvature: legend.title = "Gaussian curvature"; return legend;
    case SurfaceLook::tolerance: legend.note = "middle: within tolerance"; [[fallthrough]];
    default: break;
    }
    legend.title = "Deviation";
    if (look == SurfaceLook::deviation) {
        FieldDisplay shown;
        shown.field = Field::deviation;
        const double largest = surface.deviation.surface_to_mesh.max;
        legend.note = noise_note(shown, {-largest, largest}, size, layer.scale.shown);
    }
    return legend;
}

/// The lattice, and the picked ones of what the tool shape drags.
void add_handles(Scene& scene, const ViewerState& state)
{
    const Document& document = state.document;
    const auto& deformation = document.session.options.deformation;
    const bool shaping = state.view.tool == Tool::shape;
    if (deformation && deformation->lattice && (shaping || state.view.control_net)) {
        const StageShape shape = lattice_shape(*deformation->lattice, state.view.dark);
        scene.lines.insert(scene.lines.end(), shape.lines.begin(), shape.lines.end());
        scene.points.insert(scene.points.end(), shape.points.begin(), shape.points.end());
        scene.box.extend(shape.box);
    }
    if (!shaping)
        return;
    const HandleKind kind = state.view.handles;
    const std::vector<int>& picked = kind == HandleKind::control ? document.controls : document.lattice_points;
    if (picked.empty())
        return;
    const Eigen::Matrix3Xd place = handle_positions(document.session, kind);
    std::vector<int> shown;
    std::copy_if(picked.begin(), picked.end(), std::back_inserter(shown), [&](int h) { return h < place.cols(); });
    if (shown.empty())
        return;
    const auto points = scene_points(place(Eigen::all, shown));
    points->colour = palette::selected;
    points->size = 9;
    scene.points.push_back(points);
}

} // namespace

Scene surface_scene(const ViewerState& state, SceneCache& cache, double pixels)
{
    Scene result;
    const Session& session = state.document.session;
    const LaterResults made = surface_shown(state);
    if (!session.part || !made.surface) {
        result.empty = !session.part ? "The NURBS surface appears here once it is fitted."
                       : session.blank && state.job.running
                           ? fmt::format("There is no surface yet. Running now: {}.", state.job.title)
                       : session.lifted || session.options.patches
                           ? "Fit the surface to see it with its control net."
                           : "The NURBS surface needs the quad mesh on the part first.";
        return result;
    }
    // quick
    const SurfaceLook look =
        state.shape_dragged && has_scale(state.view.surface_look) ? SurfaceLook::plain : state.view.surface_look;
    const double tolerance = shown_tolerance(*made.surface);
    const LengthUnit lengths = state.preferences.lengths;
    const bool is_now = made.surface == session.surface; // what there was before is shown as it was
                                                         // fitted
    const SceneCache::Net net = cache.net.of({made.surface, is_now ? session.deformed : nullptr}, [&] {
        return std::make_shared<MultiPatch>(is_now ? surface_patches(session) : fitted_patches(*made.surface));
    });
    const StageShape& shape = cache.surface.of({session.part, made.grid, net, look, tolerance, lengths}, [&] {
        if (const auto& source = made.surface->source)
            return surface_shape(*net, {source->sheet.mesh, source->part_faces}, look, tolerance, lengths);
        const FilledMesh& filled = *made.grid->result.filled;
        return surface_shape(*net, {filled.mesh, filled.part_triangles}, look, tolerance, lengths);
    });
    result.layers = shape.layers;
    for (SceneLayer& layer : result.layers) {
        layer.edges = false; // its triangles are only how it is drawn
        layer.features = state.view.features;
    }
    result.box = shape.box;
    if (has_scale(look))
        result.legend = legend_of(look, *made.surface, result.layers.front(), shape.box.diagonal().norm(), lengths);
    if (state.view.control_net) {
        const double mm_per_pixel = state.view.camera[size_t(View::surface)].height / pixels;
        const double strength =
            control_net_strength(cache.net_spacing.of({net}, [&] { return control_net_spacing(*net); }) / mm_per_pixel);
        if (strength == 0 && result.legend)
            result.legend->note += result.legend->note.empty() ? "control net: zoom in" : ", control net: zoom in";
        const StageShape& drawn = cache.control_net.of(
            {net, state.view.dark, strength}, [&] { return control_net_shape(*net, state.view.dark, strength); });
        result.lines = drawn.lines;
        result.points = drawn.points;
        result.box.extend(drawn.box);
    }
    if (is_now)
        add_handles(result, state);
    add_measurements(result, state, View::surface, cache);
    add_part_outlines(result, state, cache);
    return result;
}

} // namespace spia::viewer
