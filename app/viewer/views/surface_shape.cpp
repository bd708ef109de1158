#include "app/viewer/views/surface_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/viewer/views/colour_scale.h"
#include "app/viewer/views/palette.h"
#include "app/viewer/views/scene_mesh.h"
#include "engine/core/parallel.h"
#include "engine/exchange/export_scene.h"
#include "engine/mesh/closest_point.h"
#include "engine/nurbs/basis.h"

namespace spia::viewer {
namespace {

/// Samples per span: the surface looks smooth, and a net of many spans stays quick to draw.
int samples(const NurbsSurface& surface)
{
    const auto spans = [](const std::vector<double>& knots, int degree) {
        return double(span_borders(knots, degree).size()) - 1;
    };
    const double cells = spans(surface.knots_u, surface.degree_u) * spans(surface.knots_v, surface.degree_v);
    constexpr double most_triangles = 250000;
    constexpr int finest = 6;
    return std::clamp(int(std::sqrt(most_triangles / (2 * cells))), 1, finest);
}

} // namespace

Eigen::VectorXd surface_deviation(const Tessellation& surface, const FilledMesh& part)
{
    const ClosestPointSearch search(part.mesh);
    Eigen::VectorXd result(surface.mesh.vertices());
    parallel_for(surface.mesh.vertices(), [&](int v) {
        const Eigen::Vector3d point = surface.mesh.position.col(v);
        const ClosestPoint nearest = search.nearest(point);
        if (part.is_fill(nearest.face)) {
            result[v] = std::numeric_limits<double>::quiet_NaN();
            return;
        }
        const Eigen::Matrix3d corner = part.mesh.position(Eigen::all, part.mesh.triangle.col(nearest.face));
        const Eigen::Vector3d normal = (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0));
        result[v] = (point - nearest.position).dot(normal) < 0 ? -nearest.distance : nearest.distance;
    });
    return result;
}

StageShape surface_shape(const NurbsSurface& surface, const FilledMesh* part)
{
    const Tessellation tessellation = tessellate(surface, samples(surface));
    auto mesh = std::make_shared<SceneMesh>(scene_mesh(tessellation.mesh));
    mesh->feature = boundary_edges(tessellation.mesh); // a NURBS surface is smooth; what is sharp is only bent strongly
    SceneLayer layer;
    layer.mesh = mesh;
    layer.colour = palette::surface;
    if (part) {
        const Eigen::VectorXd deviation = surface_deviation(tessellation, *part);
        layer.field = scene_field(*mesh, deviation, false);
        double largest = 0;
        for (const double d : deviation)
            if (std::isfinite(d))
                largest = std::max(largest, std::abs(d));
        const Eigen::Vector3d size =
            part->mesh.position.rowwise().maxCoeff() - part->mesh.position.rowwise().minCoeff();
        largest = std::max(largest, least_range(Field::deviation, size.norm()));
        const RoundRange range = round_range(-largest, largest, 0, true);
        layer.scale = {.map = ColourMap::diverging,
                       .least = float(range.least),
                       .greatest = float(range.greatest),
                       .ticks = range.intervals};
    }
    StageShape shape;
    shape.layers.push_back(std::move(layer));
    shape.box = {tessellation.mesh.position.rowwise().minCoeff(), tessellation.mesh.position.rowwise().maxCoeff()};
    return shape;
}

StageShape control_net_shape(const NurbsSurface& surface, bool dark)
{
    StageShape shape;
    // The denser the net, the fainter: it is not to cover the surface. As on a drawing, what is hidden is fainter still.
    Colour colour = palette::net(dark);
    colour[3] *= std::clamp(14.f / float(std::max(surface.count_u, surface.count_v)), 0.2f, 1.f);
    const auto hidden = scene_lines(surface.control, net_lines(surface.count_u, surface.count_v));
    hidden->colour = colour;
    hidden->colour[3] *= 0.3f;
    hidden->on_top = true;
    const auto seen = std::make_shared<SceneLines>(*hidden);
    seen->colour = colour;
    seen->on_top = false;
    shape.lines = {seen, hidden};
    const auto points = scene_points(surface.control);
    points->colour = colour;
    points->size = 3;
    points->on_top = false;
    shape.points.push_back(points);
    shape.box = {surface.control.rowwise().minCoeff(), surface.control.rowwise().maxCoeff()};
    return shape;
}

} // namespace spia::viewer
