#include "app/viewer/views/patch_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/viewer/views/palette.h"
#include "app/viewer/views/scene_mesh.h"
#include "app/viewer/views/surface_shape.h"
#include "engine/exchange/export_scene.h"

namespace spia::viewer {
namespace {

QuadGrid grid_of(const PatchesFit& fit, size_t patch, const TriMesh& part)
{
    QuadGrid grid;
    grid.columns = int(fit.u[patch].size()) - 1;
    grid.rows = int(fit.v[patch].size()) - 1;
    grid.position.resize(3, grid.nodes());
    for (int n = 0; n < grid.nodes(); ++n) {
        const MeshPoint& place = fit.place[patch][size_t(n)];
        grid.position.col(n) = part.position(Eigen::all, part.triangle.col(place.face)) * place.barycentric;
    }
    return grid;
}

/// Pairs of points, one pair after the other.
std::shared_ptr<SceneLines> lines_of(const std::vector<Eigen::Vector3d>& ends)
{
    Eigen::Matrix3Xd position(3, Eigen::Index(ends.size()));
    Eigen::Matrix2Xi pairs(2, position.cols() / 2);
    for (Eigen::Index i = 0; i < position.cols(); ++i) {
        position.col(i) = ends[size_t(i)];
        pairs(i % 2, i / 2) = int(i);
    }
    return scene_lines(position, pairs);
}

} // namespace

StageShape patch_mesh_shape(const PatchesFit& fit, const TriMesh& part)
{
    StageShape shape;
    const std::vector<int> colour = patch_colours(fit.patches);
    std::array<std::vector<QuadGrid>, palette::patches.size()> group;
    std::vector<Eigen::Vector3d> lines, sides;
    for (size_t p = 0; p < fit.patches.patch.size(); ++p) {
        QuadGrid grid = grid_of(fit, p, part);
        shape.box.extend(Eigen::AlignedBox3d(grid.position.rowwise().minCoeff(), grid.position.rowwise().maxCoeff()));
        const auto line = [&](int a, int b, bool side) {
            auto& into = side ? sides : lines;
            into.push_back(grid.position.col(a));
            into.push_back(grid.position.col(b));
        };
        for (int j = 0; j <= grid.rows; ++j)
            for (int i = 0; i <= grid.columns; ++i) {
                if (i < grid.columns)
                    line(grid.node(i, j), grid.node(i + 1, j), j == 0 || j == grid.rows);
                if (j < grid.rows)
                    line(grid.node(i, j), grid.node(i, j + 1), i == 0 || i == grid.columns);
            }
        group[size_t(colour[p])].push_back(std::move(grid));
    }
    for (size_t c = 0; c < group.size(); ++c) {
        TriMesh mesh;
        Eigen::Index vertices = 0, triangles = 0;
        for (const QuadGrid& grid : group[c]) {
            vertices += grid.nodes();
            triangles += 2 * Eigen::Index(grid.columns) * grid.rows;
        }
        if (triangles == 0)
            continue;
        mesh.position.resize(3, vertices);
        mesh.triangle.resize(3, triangles);
        vertices = triangles = 0;
        for (const QuadGrid& grid : group[c]) {
            const TriMesh quads = triangles_of(grid);
            mesh.position.middleCols(vertices, quads.vertices()) = quads.position;
            mesh.triangle.middleCols(triangles, quads.triangles()) = quads.triangle.array() + int(vertices);
            vertices += quads.vertices();
            triangles += quads.triangles();
        }
        SceneLayer layer;
        layer.mesh = std::make_shared<SceneMesh>(scene_mesh(mesh));
        layer.colour = layer.back = palette::patches[c];
        layer.features = false; // the lines say more
        shape.layers.push_back(std::move(layer));
    }
    const auto cells = lines_of(lines), borders = lines_of(sides);
    // The denser, the fainter: as many as a grid of 40 by 40 has are seen well.
    cells->colour = {0.05f, 0.06f, 0.08f, std::clamp(24.f / std::sqrt(float(lines.size()) / 4), 0.06f, 0.5f)};
    borders->colour = palette::casing;
    borders->width = fit.patches.patch.size() > 40 ? 1.4f : 2.6f;
    shape.lines = {cells, borders};
    return shape;
}

LineList layout_lines(const Layout& layout, bool dark)
{
    std::vector<Eigen::Vector3d> ends;
    for (const LayoutCurve& curve : layout.curve)
        for (Eigen::Index i = 0; i + 1 < curve.plane.cols(); ++i)
            for (const Eigen::Index k : {i, i + 1})
                ends.push_back({curve.plane(0, k), curve.plane(1, k), 0});
    const bool few = layout.patch.size() <= 40;
    LineList result;
    for (const auto& [colour, width] :
         {std::pair(palette::casing, few ? 4.2f : 2.6f), std::pair(palette::outline(dark), few ? 2.f : 1.1f)}) {
        const auto lines = lines_of(ends);
        lines->colour = colour;
        lines->width = width;
        result.push_back(lines);
    }
    return result;
}

} // namespace spia::viewer
