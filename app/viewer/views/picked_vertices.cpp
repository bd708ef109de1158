#include "app/viewer/views/picked_vertices.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/views/palette.h"
#include "app/viewer/views/scene_mesh.h"
#include "engine/report/text/lengths.h"

namespace spia::viewer {
namespace {

constexpr size_t most_labels = 8; ///< more would cover the sheet

VertexShape vertex_shape(const std::vector<int>& vertices, const Eigen::Matrix3Xd& position, bool dark)
{
    VertexShape shape;
    if (vertices.empty())
        return shape;
    shape.dots = scene_points(position(Eigen::all, vertices));
    shape.dots->colour = palette::selected;
    shape.dots->size = 8; // a corner that is there, too, shows around it
    if (vertices.size() == 2)
        for (const auto& [colour, width] :
             {std::pair(palette::measure_casing(dark), 3.5f), std::pair(palette::measure(dark), 1.5f)}) {
            const auto line = scene_lines(position, Eigen::Matrix<int, 2, 1>(vertices[0], vertices[1]));
            line->colour = colour;
            line->width = width;
            line->on_top = true;
            shape.line.push_back(line);
        }
    return shape;
}

} // namespace

void add_picked_vertices(Scene& scene, const ViewerState& state, SceneCache::Vertices& cache,
                         const std::shared_ptr<const SceneMesh>& sheet, const Eigen::Matrix3Xd& position)
{
    const auto there = [&](int v) { return v >= 0 && v < position.cols(); };
    const std::vector<int>& vertices = state.document.vertices;
    const std::vector<int>& in_file = state.document.session.part->source_vertex;
    const Colour text = palette::text(state.view.dark);
    if (state.hovered_vertex && there(*state.hovered_vertex))
        scene.rings.push_back({position.col(*state.hovered_vertex)});
    if (!std::all_of(vertices.begin(), vertices.end(), there))
        return; // of another part
    const VertexShape& shape =
        cache.of({sheet, vertices, state.view.dark}, [&] { return vertex_shape(vertices, position, state.view.dark); });
    scene.lines.insert(scene.lines.end(), shape.line.begin(), shape.line.end());
    if (shape.dots)
        scene.points.push_back(shape.dots);
    if (vertices.size() <= most_labels)
        for (const int v : vertices)
            scene.labels.push_back({position.col(v), fmt::format("{}", in_file[size_t(v)]), text});
    if (vertices.size() == 2) {
        const Eigen::Vector3d a = position.col(vertices[0]), b = position.col(vertices[1]);
        scene.labels.push_back({(a + b) / 2, fixed_length((b - a).norm(), state.preferences.lengths, 2), text});
    }
}

} // namespace spia::viewer
