#include <fmt/core.h>

#include "app/viewer/views/colour_scale.h"
#include "app/viewer/views/grid_shapes.h"
#include "app/viewer/views/measurements.h"
#include "app/viewer/views/palette.h"
#include "app/viewer/views/patch_shapes.h"
#include "app/viewer/views/scene_mesh.h"
#include "app/viewer/views/sheet_shapes.h"
#include "app/viewer/views/views.h"
#include "engine/coons/cell_quality.h"
#include "engine/core/text.h"

namespace spia::viewer {
namespace {

std::string what_is_missing(const Session& session)
{
    if (!session.part)
        return "The quad mesh appears here once a part is open and unfolded.";
    if (!session.blank)
        return "Unfold the part first; then the blank can be filled with a grid.";
    if (made_of_patches(session))
        return "Make the patches to see their quads on the part.";
    if (!session.grid)
        return "Make the grid to see the quad mesh on the part.";
    if (const int folded = session.grid->result.quality.folded_cells; folded > 0)
        return fmt::format(
            "{} folded, so it cannot be put on the part. See what is red on the blank; move the corners or choose "
            "another method.",
            counted(folded, "cell of the grid is", "cells of the grid are"));
    return "The grid is not on the part yet: press Update all (F5).";
}

/// A ring and a text at the cell with the least scaled Jacobian.
void add_worst_cell(Scene& scene, const QuadGrid& lifted, const CellQuality& quality, bool dark)
{
    const auto [i, j] = lifted.column_and_row(quality.worst_cell);
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int node : {lifted.node(i, j), lifted.node(i + 1, j), lifted.node(i, j + 1), lifted.node(i + 1, j + 1)})
        middle += lifted.position.col(node) / 4;
    scene.rings.push_back({middle});
    scene.labels.push_back(
        {middle, fmt::format("min {} (column {}, row {})", value_text(quality.min_scaled_jacobian, ""), i, j),
         palette::text(dark)});
}

} // namespace

Scene quad_scene(const ViewerState& state, SceneCache& cache)
{
    Scene result;
    const Session& session = state.document.session;
    const LaterResults made = quads_shown(state);
    if (session.part && made.surface && made.surface->patches) {
        const StageShape& shape = cache.patch_mesh.of(
            {made.surface}, [&] { return patch_mesh_shape(*made.surface->patches, session.part->mesh); });
        result.layers = shape.layers;
        result.lines = shape.lines;
        result.box = shape.box;
        add_part_outlines(result, state, cache);
        return result;
    }
    if (!session.part || !made.lifted) {
        result.empty = session.blank && state.job.running
                           ? fmt::format("There is no quad mesh yet. Running now: {}.", state.job.title)
                           : what_is_missing(session);
        return result;
    }
    const QuadGrid& lifted = made.lifted->lifted;
    const bool by_quality = state.view.quad_quality;
    const StageShape& quads = cache.quads.of({made.grid, made.lifted, by_quality}, [&] {
        return lifted_grid_shape(lifted, made.grid->result.planar, by_quality);
    });
    result.layers = quads.layers;
    result.lines = quads.lines;
    result.box = quads.box;
    if (by_quality)
        result.legend = {"Scaled Jacobian", "", quality_scale()};
    if (state.view.part_under_quads) {
        const PartShape& part = part_shape(state, cache);
        SceneLayer ghost;
        ghost.mesh = part.mesh;
        ghost.colour = ghost.back = palette::ghost;
        ghost.features = false; // they would be taken for lines of the quads
        result.layers.push_back(ghost);
        const LineList& boundary = cache.boundary_on_quads.of({session.part}, [&] {
            const auto lines = scene_lines(session.part->mesh.position, part.boundary);
            lines->colour = palette::casing;
            lines->width = 1.6f;
            return LineList{lines};
        });
        // under the sides
        result.lines.insert(result.lines.begin(), boundary.begin(), boundary.end());
        result.box.extend(part.box);
    }
    Eigen::Matrix3Xd corner(3, 4);
    corner << lifted.position.col(lifted.node(0, 0)), lifted.position.col(lifted.node(lifted.columns, 0)),
        lifted.position.col(lifted.node(lifted.columns, lifted.rows)), lifted.position.col(lifted.node(0, lifted.rows));
    add_corners(result, corner, state.view.dark);
    if (by_quality && state.document.display.extremes)
        add_worst_cell(result, lifted, made.grid->result.quality, state.view.dark);
    add_measurements(result, state, View::quads, cache);
    add_part_outlines(result, state, cache);
    return result;
}

} // namespace spia::viewer
