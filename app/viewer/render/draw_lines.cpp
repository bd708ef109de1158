#include <cmath>

#include "app/viewer/render/scene_drawer.h"
#include "app/viewer/views/colours.h"

namespace spia::viewer {
namespace {

constexpr Colour ink{0.07f, 0.08f, 0.10f, 1};

Colour faded(Colour colour, float opacity)
{
    colour[3] *= opacity;
    return colour;
}

} // namespace

/// Edges thin and pale, so that a fine mesh does not turn black; boundary and sharp edges strong.
void SceneDrawer::draw_layer_lines(const Pass& pass, const SceneLayer& layer)
{
    if (!layer.edges && !layer.features)
        return;
    MeshBuffer& mesh = uploads_.of(layer.mesh);
    line_shader_.use();
    place(line_shader_, pass, layer.mesh->origin);
    const auto stroke = [&](std::optional<LineBuffer>& lines, const auto& ends, float width, float opacity,
                            bool round_ends, float lift) {
        if (!lines)
            lines = upload_lines(layer.mesh->position, ends);
        line_shader_.set("line_colour", faded(ink, opacity * (transparent(layer) ? std::sqrt(layer.colour[3]) : 1)));
        line_shader_.set("width", width * pass.look.content_scale);
        line_shader_.set("lift", lift);
        line_shader_.set("round_ends", round_ends);
        glBindVertexArray(lines->array);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, lines->lines);
    };
    if (layer.edges && !is_coarse(pass, layer))
        stroke(mesh.edge, layer.mesh->edge, 1, 0.38f, false, 0);
    // in the same ink: they are what is asked about
    const bool isolines = layer.field && layer.scale.isolines;
    if (layer.features)
        stroke(mesh.feature, layer.mesh->feature, 1.4f, isolines ? 0.25f : 0.7f, true, 0.5f * pass.lift);
}

void SceneDrawer::draw_lines(const Pass& pass, bool on_top)
{
    line_shader_.use();
    for (const auto& lines : pass.scene.lines) {
        if (lines->on_top != on_top)
            continue;
        const LineBuffer& buffer = uploads_.of(lines).lines;
        place(line_shader_, pass, lines->origin);
        line_shader_.set("line_colour", lines->colour);
        line_shader_.set("width", lines->width * pass.look.content_scale);
        line_shader_.set("lift", on_top ? 0.f : pass.lift);
        line_shader_.set("round_ends", true);
        glBindVertexArray(buffer.array);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, buffer.lines);
    }
}

void SceneDrawer::draw_points(const Pass& pass, bool on_top)
{
    point_shader_.use();
    for (const auto& points : pass.scene.points) {
        if (points->on_top != on_top)
            continue;
        const PointBuffer& buffer = uploads_.of(points);
        constexpr float least_with_rim = 7; // pixels
        const float rim = points->size >= least_with_rim ? 1.6f : 0;
        place(point_shader_, pass, points->origin);
        point_shader_.set("dot_colour", points->colour);
        point_shader_.set("rim_colour", lightness(points->colour) > 0.72 ? ink : Colour{1, 1, 1, 1});
        point_shader_.set("diameter", (points->size + 2 * rim) * pass.look.content_scale);
        point_shader_.set("rim", rim * pass.look.content_scale);
        point_shader_.set("lift", on_top ? 0.f : 2 * pass.lift);
        glBindVertexArray(buffer.array);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, buffer.points);
    }
}

} // namespace spia::viewer
