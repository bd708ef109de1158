#include "app/viewer/views/colour_scale.h"
#include "app/viewer/views/sheet_shapes.h"
#include "app/viewer/views/surface_shape.h"
#include "app/viewer/views/views.h"

namespace spia::viewer {

Scene surface_scene(const ViewerState& state, SceneCache& cache)
{
    Scene result;
    const Session& session = state.document.session;
    const LaterResults made = surface_shown(state);
    if (!session.part || !made.surface) {
        result.empty = !session.part    ? "The NURBS surface appears here at the end of the chain."
                       : session.lifted ? "Fit the surface to see it with its control net."
                                        : "The NURBS surface needs the quad mesh on the part first.";
        return result;
    }
    const NurbsSurface& surface = made.surface->result.surface;
    const bool by_deviation = state.view.surface_deviation;
    const StageShape& shape = cache.surface.of({session.part, made.grid, made.surface, by_deviation}, [&] {
        return surface_shape(surface, by_deviation ? made.grid->result.filled.get() : nullptr);
    });
    result.layers = shape.layers;
    for (SceneLayer& layer : result.layers) {
        layer.edges = false; // its triangles are only how it is drawn
        layer.features = state.view.features;
    }
    result.box = shape.box;
    if (by_deviation) {
        result.legend = {"Deviation", "mm", shape.layers.front().scale};
        FieldDisplay shown;
        shown.field = Field::deviation;
        const double largest = made.surface->deviation.surface_to_mesh.max;
        result.legend->note = noise_note(shown, {-largest, largest}, part_shape(state, cache).box.diagonal().norm());
    }
    if (state.view.control_net) {
        const StageShape& net = cache.control_net.of({made.surface, state.view.dark},
                                                     [&] { return control_net_shape(surface, state.view.dark); });
        result.lines = net.lines;
        result.points = net.points;
        result.box.extend(net.box);
    }
    add_part_outlines(result, state, cache);
    return result;
}

} // namespace spia::viewer
