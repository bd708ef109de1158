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
#include "engine/nurbs/evaluate.h"

namespace spia::viewer {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Samples per span: the surface looks smooth, and a net of many spans stays quick to draw.
int samples(const MultiPatch& surface)
{
    const auto spans = [](const std::vector<double>& knots, int degree) {
        return double(span_borders(knots, degree).size()) - 1;
    };
    double cells = 0;
    for (const NurbsSurface& patch : surface.patch)
        cells += spans(patch.knots_u, patch.degree_u) * spans(patch.knots_v, patch.degree_v);
    constexpr double most_triangles = 250000;
    constexpr int finest = 6;
    return std::clamp(int(std::sqrt(most_triangles / (2 * cells))), 1, finest);
}

/// Per span along u and v: no fewer than `fine`, and as many as leave no cell longer than a length.
/// A span may be as long as the part, and what is hatched over its holes is drawn cell by cell.
std::array<int, 2> samples(const NurbsSurface& patch, int fine, double length)
{
    const auto longest = [&](int rows, int places, const auto& index) {
        double result = 0;
        for (int r = 0; r < rows; ++r) {
            double row = 0; // of the control net
            for (int k = 1; k < places; ++k)
                row += (patch.control.col(index(k, r)) - patch.control.col(index(k - 1, r))).norm();
            result = std::max(result, row);
        }
        return result;
    };
    const double along_u = longest(patch.count_v, patch.count_u, [&](int i, int j) { return patch.index(i, j); });
    const double along_v = longest(patch.count_u, patch.count_v, [&](int j, int i) { return patch.index(i, j); });
    const auto in_span = [&](double row, const std::vector<double>& knots, int degree) {
        constexpr double most = 200;
        const double spans = double(span_borders(knots, degree).size()) - 1;
        return int(std::clamp(std::ceil(row / (spans * length)), double(fine), most));
    };
    return {in_span(along_u, patch.knots_u, patch.degree_u), in_span(along_v, patch.knots_v, patch.degree_v)};
}

/// Patches of one colour as one mesh.
struct Drawn {
    std::vector<Tessellation> patch;
    std::vector<Eigen::VectorXd> value; ///< per patch, one per vertex; empty: no field

    TriMesh mesh() const
    {
        Eigen::Index vertices = 0, triangles = 0;
        for (const Tessellation& p : patch) {
            vertices += p.mesh.vertices();
            triangles += p.mesh.triangles();
        }
        TriMesh all{Eigen::Matrix3Xd(3, vertices), Eigen::Matrix3Xi(3, triangles)};
        vertices = triangles = 0;
        for (const Tessellation& p : patch) {
            all.position.middleCols(vertices, p.mesh.vertices()) = p.mesh.position;
            all.triangle.middleCols(triangles, p.mesh.triangles()) = p.mesh.triangle.array() + int(vertices);
            vertices += p.mesh.vertices();
            triangles += p.mesh.triangles();
        }
        return all;
    }
    Eigen::VectorXd values() const
    {
        Eigen::Index count = 0;
        for (const Eigen::VectorXd& v : value)
            count += v.size();
        Eigen::VectorXd all(count);
        count = 0;
        for (const Eigen::VectorXd& v : value) {
            all.segment(count, v.size()) = v;
            count += v.size();
        }
        return all;
    }
};

/// With the normals of the surface instead of those of its triangles.
std::shared_ptr<SceneMesh> drawn_mesh(const TriMesh& mesh, const Drawn& group)
{
    auto result = std::make_shared<SceneMesh>(scene_mesh(mesh));
    Eigen::Index at = 0;
    for (const Tessellation& p : group.patch) {
        result->normal.middleCols(at, p.normal.cols()) = p.normal.cast<float>();
        at += p.normal.cols();
    }
    for (size_t i = 0; i < result->repeated.size(); ++i)
        result->normal.col(at + Eigen::Index(i)) = result->normal.col(result->repeated[i]);
    result->feature = boundary_edges(mesh); // a NURBS surface is smooth; what is sharp is only bent
                                            // strongly
    return result;
}

/// As far to either side as the largest value, or as nearly all of them: a curvature has peaks that
/// would hide the rest.
double reach(const Eigen::VectorXd& value, double share)
{
    std::vector<double> size;
    for (const double v : value)
        if (std::isfinite(v))
            size.push_back(std::abs(v));
    if (size.empty())
        return 0;
    const auto at = size.begin() + long(share * double(size.size() - 1));
    std::nth_element(size.begin(), at, size.end());
    return *at;
}

ColourScale scale_of(SurfaceLook look, const Eigen::VectorXd& value, double tolerance, double size, LengthUnit lengths)
{
    ColourScale scale{.map = ColourMap::diverging};
    scale.shown = as_shown(unit_of(look), lengths).factor;
    if (look == SurfaceLook::tolerance) { // one band of three lies within it
        scale.greatest = float(3 * tolerance);
        scale.least = -scale.greatest;
        scale.bands = 3;
        scale.ticks = 6;
        return scale;
    }
    double largest = look == SurfaceLook::deviation ? std::max(reach(value, 1), least_range(Field::deviation, size))
                                                    : reach(value, 0.98);
    if (look != SurfaceLook::deviation) // a plane is bent by rounding
        largest = std::max(largest, look == SurfaceLook::mean_curvature ? 1e-6 / size : 1e-6 / (size * size));
    const RoundRange range = round_range(-scale.shown * largest, scale.shown * largest, 0, true);
    scale.least = float(range.least / scale.shown);
    scale.greatest = float(range.greatest / scale.shown);
    scale.ticks = range.intervals;
    return scale;
}

} // namespace

std::string_view unit_of(SurfaceLook look)
{
    return look == SurfaceLook::mean_curvature ? "1/mm" : look == SurfaceLook::gaussian_curvature ? "1/mm\u00b2" : "mm";
}

Eigen::VectorXd surface_deviation(const Tessellation& surface, const DrawnPart& part)
{
    const ClosestPointSearch search(part.mesh);
    Eigen::VectorXd result(surface.mesh.vertices());
    parallel_for(surface.mesh.vertices(), [&](int v) {
        const Eigen::Vector3d point = surface.mesh.position.col(v);
        const ClosestPoint nearest = search.nearest(point);
        if (nearest.face >= part.part_faces) {
            result[v] = none;
            return;
        }
        const Eigen::Matrix3d corner = part.mesh.position(Eigen::all, part.mesh.triangle.col(nearest.face));
        const Eigen::Vector3d normal = (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0));
        result[v] = (point - nearest.position).dot(normal) < 0 ? -nearest.distance : nearest.distance;
    });
    return result;
}

Eigen::VectorXd surface_curvature(const NurbsSurface& surface, const Tessellation& tessellation, bool gaussian)
{
    Eigen::VectorXd result(tessellation.mesh.vertices());
    parallel_for(tessellation.mesh.vertices(), [&](int v) {
        const SurfacePoint s = evaluate(surface, tessellation.uv(0, v), tessellation.uv(1, v));
        const Eigen::Vector3d n = s.normal();
        const double E = s.S_u.squaredNorm(), F = s.S_u.dot(s.S_v), G = s.S_v.squaredNorm(), L = n.dot(s.S_uu),
                     M = n.dot(s.S_uv), N = n.dot(s.S_vv), area = E * G - F * F;
        result[v] = n.isZero() || !(area > 0) ? none
                    : gaussian                ? (L * N - M * M) / area
                                              : (E * N - 2 * F * M + G * L) / (2 * area);
    });
    return result;
}

std::vector<int> patch_colours(const MultiPatch& surface)
{
    const size_t count = surface.patch.size();
    std::vector<std::vector<int>> beside(count);
    for (const PatchInterface& joint : surface.interfaces) {
        beside[size_t(joint.first.patch)].push_back(joint.second.patch);
        beside[size_t(joint.second.patch)].push_back(joint.first.patch);
    }
    std::vector<int> colour(count, -1);
    for (size_t p = 0; p < count;
         ++p) { // the first that is free; a side of a patch has one neighbour, so four are taken at
                // most
        std::array<bool, palette::patches.size()> taken{};
        for (const int q : beside[p])
            if (colour[size_t(q)] >= 0)
                taken[size_t(colour[size_t(q)])] = true;
        colour[p] = int(std::find(taken.begin(), taken.end(), false) - taken.begin()) % int(taken.size());
    }
    return colour;
}

StageShape surface_shape(const MultiPatch& surface, const DrawnPart& part, SurfaceLook look, double tolerance,
                         LengthUnit lengths)
{
    const int fine = samples(surface);
    const double size = (part.mesh.position.rowwise().maxCoeff() - part.mesh.position.rowwise().minCoeff()).norm();
    constexpr double longest_cell = 1. / 200; // of the size: some pixels
    const std::vector<int> colour =
        look == SurfaceLook::patches ? patch_colours(surface) : std::vector<int>(surface.patch.size(), 0);
    std::array<Drawn, palette::patches.size()> drawn;
    for (size_t p = 0; p < surface.patch.size(); ++p) {
        Tessellation patch = tessellate(surface.patch[p], samples(surface.patch[p], fine, longest_cell * size));
        Drawn& group = drawn[size_t(colour[p])];
        if (look == SurfaceLook::deviation || look == SurfaceLook::tolerance)
            group.value.push_back(surface_deviation(patch, part));
        else if (has_scale(look))
            group.value.push_back(surface_curvature(surface.patch[p], patch, look == SurfaceLook::gaussian_curvature));
        group.patch.push_back(std::move(patch));
    }
    StageShape shape;
    for (size_t c = 0; c < drawn.size(); ++c) {
        if (drawn[c].patch.empty())
            continue;
        const TriMesh mesh = drawn[c].mesh();
        SceneLayer layer;
        layer.mesh = drawn_mesh(mesh, drawn[c]);
        layer.colour = look == SurfaceLook::patches ? palette::patches[c] : palette::surface;
        layer.zebra = look == SurfaceLook::zebra;
        if (has_scale(look)) {
            const Eigen::VectorXd value = drawn[c].values();
            layer.field = scene_field(*layer.mesh, value, false);
            layer.scale = scale_of(look, value, tolerance, size, lengths);
        }
        shape.layers.push_back(std::move(layer));
        shape.box.extend(Eigen::AlignedBox3d(mesh.position.rowwise().minCoeff(), mesh.position.rowwise().maxCoeff()));
    }
    return shape;
}

StageShape lattice_shape(const Lattice& lattice, bool dark)
{
    const Eigen::Matrix3Xd place = rest_positions(lattice) + lattice.move;
    std::vector<std::array<int, 2>> edges;
    const auto& n = lattice.count;
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i) {
                const int here = lattice.index(i, j, k);
                if (i + 1 < n[0])
                    edges.push_back({here, lattice.index(i + 1, j, k)});
                if (j + 1 < n[1])
                    edges.push_back({here, lattice.index(i, j + 1, k)});
                if (k + 1 < n[2])
                    edges.push_back({here, lattice.index(i, j, k + 1)});
            }
    Eigen::Matrix2Xi ends(2, Eigen::Index(edges.size()));
    for (size_t e = 0; e < edges.size(); ++e)
        ends.col(Eigen::Index(e)) << edges[e][0], edges[e][1];
    StageShape shape;
    const auto lines = scene_lines(place, ends);
    lines->colour = palette::lattice(dark);
    lines->colour[3] = 0.5f;
    lines->on_top = true;
    shape.lines = {lines};
    const auto points = scene_points(place);
    points->colour = palette::lattice(dark);
    points->size = 6;
    shape.points.push_back(points);
    shape.box = {place.rowwise().minCoeff(), place.rowwise().maxCoeff()};
    return shape;
}

double control_net_spacing(const MultiPatch& surface)
{
    double sum = 0;
    Eigen::Index count = 0;
    for (const NurbsSurface& patch : surface.patch) {
        const Eigen::Matrix2Xi net = net_lines(patch.count_u, patch.count_v);
        for (Eigen::Index k = 0; k < net.cols(); ++k)
            sum += (patch.control.col(net(1, k)) - patch.control.col(net(0, k))).norm();
        count += net.cols();
    }
    return count > 0 ? sum / double(count) : 0;
}

double control_net_strength(double pixels)
{
    constexpr double least = 5, full = 25; // of lines 1 pixel wide: they cover 2/5 of the surface,
                                           // or 2/25
    return std::round(8 * std::clamp((pixels - least) / (full - least), 0., 1.)) / 8;
}

StageShape control_net_shape(const MultiPatch& surface, bool dark, double strength)
{
    Eigen::Index controls = 0, edges = 0;
    for (const NurbsSurface& patch : surface.patch) {
        controls += patch.control.cols();
        edges += net_lines(patch.count_u, patch.count_v).cols();
    }
    Eigen::Matrix3Xd control(3, controls);
    Eigen::Matrix2Xi lines(2, edges);
    controls = edges = 0;
    for (const NurbsSurface& patch : surface.patch) {
        const Eigen::Matrix2Xi net = net_lines(patch.count_u, patch.count_v);
        control.middleCols(controls, patch.control.cols()) = patch.control;
        lines.middleCols(edges, net.cols()) = net.array() + int(controls);
        controls += patch.control.cols();
        edges += net.cols();
    }
    StageShape shape;
    shape.box = {control.rowwise().minCoeff(), control.rowwise().maxCoeff()};
    if (strength <= 0)
        return shape;
    // As on a drawing, what is hidden is fainter.
    Colour colour = palette::net(dark);
    colour[3] *= float(strength);
    const auto hidden = scene_lines(control, lines);
    hidden->colour = colour;
    hidden->colour[3] *= 0.3f;
    hidden->on_top = true;
    const auto seen = std::make_shared<SceneLines>(*hidden);
    seen->colour = colour;
    seen->on_top = false;
    shape.lines = {seen, hidden};
    const auto points = scene_points(control);
    points->colour = colour;
    points->size = 3;
    points->on_top = false;
    shape.points.push_back(points);
    return shape;
}

} // namespace spia::viewer
