#include "engine/exchange/export_scene.h"

#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/exchange/sheet_field_list.h"

namespace spia {

void require_complete(const ExportScene& scene)
{
    if (!scene.part || !scene.blank || !scene.fields)
        throw InputError("there is no flattened part to show; flatten it first");
    require_blank_of(*scene.part, *scene.blank);
    require_zones(scene.zones, *scene.part);
    require_fields(*scene.fields, scene.part->vertices(), "vertex");
    if (const QuadGrid* grid = scene.quad_mesh;
        grid &&
        (grid->columns < 1 || grid->rows < 1 || grid->position.cols() != grid->nodes() || !grid->position.allFinite()))
        throw InputError(
            fmt::format("the quad mesh of {} x {} cells does not have {} finite nodes; fill and lift it again",
                        grid->columns, grid->rows, grid->nodes()));
    if (const TriMesh* surface = scene.surface) {
        if (surface->triangles() == 0 || !surface->position.allFinite() || surface->triangle.minCoeff() < 0 ||
            surface->triangle.maxCoeff() >= surface->vertices())
            throw InputError("the triangles of the surface do not make a mesh; interpolate or fit it again");
        if (scene.surface_normal &&
            (scene.surface_normal->cols() != surface->position.cols() || !scene.surface_normal->allFinite()))
            throw InputError(fmt::format("{} normals for {} vertices of the surface, or one that is not finite",
                                         scene.surface_normal->cols(), surface->vertices()));
    }
    for (const NurbsSurface& net : scene.control_nets)
        if (net.count_u < 2 || net.count_v < 2 || net.control.cols() != Eigen::Index(net.count_u) * net.count_v ||
            !net.control.allFinite())
            throw InputError(
                fmt::format("a control net does not have {} x {} finite points; interpolate or fit it again",
                            net.count_u, net.count_v));
}

TriMesh triangles_of(const QuadGrid& grid)
{
    TriMesh mesh;
    mesh.position = grid.position;
    mesh.triangle.resize(3, 2 * grid.columns * grid.rows);
    int f = 0;
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
            mesh.triangle.col(f++) << grid.node(i, j), grid.node(i + 1, j), grid.node(i + 1, j + 1);
            mesh.triangle.col(f++) << grid.node(i, j), grid.node(i + 1, j + 1), grid.node(i, j + 1);
        }
    return mesh;
}

Eigen::Matrix2Xi net_lines(int count_u, int count_v)
{
    Eigen::Matrix2Xi lines(2, (count_u - 1) * count_v + count_u * (count_v - 1));
    int n = 0;
    for (int j = 0; j < count_v; ++j)
        for (int i = 0; i + 1 < count_u; ++i)
            lines.col(n++) << i + j * count_u, i + 1 + j * count_u;
    for (int i = 0; i < count_u; ++i)
        for (int j = 0; j + 1 < count_v; ++j)
            lines.col(n++) << i + j * count_u, i + (j + 1) * count_u;
    return lines;
}

} // namespace spia
