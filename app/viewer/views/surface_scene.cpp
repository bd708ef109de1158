#include "app/viewer/views/sheet_shapes.h"
#include "app/viewer/views/surface_shape.h"
#include "app/viewer/views/views.h"

namespace spia::viewer {

Scene surface_scene(const ViewerState& state, SceneCache& cache)
{
    Scene result;
    const Session& session = state.document.session;
    if (!session.part || !session.grid || !session.surface) {
        result.empty = !session.part    ? "The NURBS surface appears here at the end of the chain."
                       : session.lifted ? "Fit the surface to see it with its control net."
                                        : "The NURBS surface needs the quad mesh on the part first.";
        return result;
    }
    const NurbsSurface& surface = session.surface->result.surface;
    const bool by_deviation = state.view.surface_deviation;
    const StageShape& shape = cache.surface.of({session.part, session.grid, session.surface, by_deviation}, [&] {
        return surface_shape(surface, by_deviation ? session.grid->result.filled.get() : nullptr);
    });
    result.layers = shape.layers;
    for (SceneLayer& layer : result.layers) {
        layer.edges = false; // its triangles are only how it is drawn
        layer.features = state.view.features;
    }
    result.box = shape.box;
    if (by_deviation)
        result.legend = {"Deviation", "mm", shape.layers.front().scale};
    if (state.view.control_net) {
        const StageShape& net = cache.control_net.of({session.surface, state.view.dark},
                                                     [&] { return control_net_shape(surface, state.view.dark); });
        result.lines = net.lines;
        result.points = net.points;
        result.box.extend(net.box);
    }
    add_part_outlines(result, state, cache);
    return result;
}

} // namespace spia::viewer
