#include "app/viewer/views/grid_shapes.h"

#include <fmt/core.h>

#include "app/viewer/views/palette.h"
#include "app/viewer/views/scene_mesh.h"
#include "engine/coons/cell_quality.h"
#include "engine/exchange/export_scene.h"

namespace spia::viewer {
namespace {

/// Two triangles per cell of those that `wanted` accepts, and their lines of the border as
/// features.
TriMesh some_cells(const QuadGrid& grid, const std::vector<int>& cells)
{
    const TriMesh all = triangles_of(grid);
    TriMesh result{grid.position, Eigen::Matrix3Xi(3, 2 * Eigen::Index(cells.size()))};
    for (size_t i = 0; i < cells.size(); ++i)
        result.triangle.middleCols<2>(2 * Eigen::Index(i)) = all.triangle.middleCols<2>(2 * Eigen::Index(cells[i]));
    return result;
}

struct Sorted {
    std::vector<int> good, folded; ///< cells
};

Sorted sorted(const Eigen::VectorXd& jacobian)
{
    Sorted result;
    for (int c = 0; c < jacobian.size(); ++c)
        (jacobian[c] > 0 ? result.good : result.folded).push_back(c);
    return result;
}

SceneLayer layer_of(const TriMesh& mesh, const Colour& colour)
{
    SceneLayer layer;
    layer.mesh = std::make_shared<SceneMesh>(scene_mesh(mesh));
    layer.colour = layer.back = colour;
    layer.features = false; // the lines of the grid say more
    return layer;
}

std::shared_ptr<SceneLines> grid_lines(const QuadGrid& grid)
{
    return scene_lines(grid.position, net_lines(grid.columns + 1, grid.rows + 1));
}

/// The sides v = 0, u = 1, v = 1, u = 0.
LineList side_lines(const QuadGrid& grid)
{
    const auto along = [&](int count, const auto& node) {
        Eigen::Matrix2Xi ends(2, count);
        for (int i = 0; i < count; ++i)
            ends.col(i) << node(i), node(i + 1);
        return ends;
    };
    const int n = grid.columns, m = grid.rows;
    const Eigen::Matrix2Xi side[] = {
        along(n, [&](int i) { return grid.node(i, 0); }), along(m, [&](int j) { return grid.node(n, j); }),
        along(n, [&](int i) { return grid.node(i, m); }), along(m, [&](int j) { return grid.node(0, j); })};
    LineList result;
    for (size_t k = 0; k < 4; ++k) {
        const auto lines = scene_lines(grid.position, side[k]);
        lines->colour = palette::sides()[k];
        lines->width = 5;
        result.push_back(lines);
    }
    return result;
}

} // namespace

ColourScale quality_scale() { return {.map = ColourMap::quality, .least = 0, .greatest = 1, .ticks = 10}; }

StageShape planar_grid_shape(const QuadGrid& planar, bool with_lines)
{
    StageShape shape;
    const std::vector<int> folded = sorted(scaled_jacobians(planar)).folded;
    if (!folded.empty()) {
        shape.layers.push_back(layer_of(some_cells(planar, folded), palette::folded));
        shape.layers.back().lit = false;
    }
    if (with_lines) {
        const auto lines = grid_lines(planar);
        lines->colour = {0.05f, 0.06f, 0.08f, 0.75f};
        lines->width = 1.2f;
        shape.lines.push_back(lines);
    }
    return shape;
}

StageShape lifted_grid_shape(const QuadGrid& lifted, const QuadGrid& planar, bool by_quality)
{
    StageShape shape;
    const Eigen::VectorXd jacobian = scaled_jacobians(planar);
    const auto [good, folded] = sorted(jacobian);
    if (!good.empty()) {
        SceneLayer layer = layer_of(some_cells(lifted, good), palette::quads);
        layer.back = SceneLayer{}.back;
        if (by_quality) {
            auto field = std::make_shared<SceneField>();
            field->per_face = true;
            field->value.resize(2 * Eigen::Index(good.size()));
            for (size_t i = 0; i < good.size(); ++i)
                field->value.segment<2>(2 * Eigen::Index(i)).setConstant(float(jacobian[good[i]]));
            layer.field = field;
            layer.scale = quality_scale();
        }
        shape.layers.push_back(std::move(layer));
    }
    if (!folded.empty())
        shape.layers.push_back(layer_of(some_cells(lifted, folded), palette::folded));
    const auto lines = grid_lines(lifted);
    lines->colour = {0.05f, 0.06f, 0.08f, 0.6f};
    lines->width = 1;
    shape.lines.push_back(lines);
    for (const auto& side : side_lines(lifted))
        shape.lines.push_back(side);
    shape.box = {lifted.position.rowwise().minCoeff(), lifted.position.rowwise().maxCoeff()};
    return shape;
}

void add_corners(Scene& scene, const Eigen::Matrix3Xd& place, bool dark)
{
    const auto points = scene_points(place);
    points->colour = palette::corner;
    points->size = 11;
    scene.points.push_back(points);
    for (int k = 0; k < 4; ++k)
        scene.labels.push_back({place.col(k), fmt::format("{}", k + 1), palette::text(dark), LabelKind::corner});
}

} // namespace spia::viewer
