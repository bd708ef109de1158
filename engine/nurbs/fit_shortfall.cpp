#include "engine/nurbs/fit_shortfall.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <functional>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"
#include "engine/mesh/vectors.h"

namespace spia {

namespace {

double distance_to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
    const double length2 = (b - a).squaredNorm();
    const double t = length2 > 0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0;
    return (p - a - t * (b - a)).norm();
}

struct Sharpest {
    int a = -1, b = -1;
    double angle = 0;
};

std::array<Eigen::Vector3d, 4> corners_of(const NurbsSurface& surface)
{
    const int m = surface.count_u - 1, n = surface.count_v - 1;
    return {surface.control.col(surface.index(0, 0)), surface.control.col(surface.index(m, 0)),
            surface.control.col(surface.index(m, n)), surface.control.col(surface.index(0, n))};
}

/// The edge within reach, and the corner of a border, between the faces of the part.
/// @param number  per vertex in the file. A smooth sheet is of finer triangles than the part: of
/// its edges those count whose ends are two vertices of the file
void look_around(const TriMesh& mesh, int part_faces, const std::array<Eigen::Vector3d, 4>& own_corners,
                 const std::function<int(int)>& number, const Eigen::Vector3d& where, double reach, Sharpest& edge,
                 Sharpest& corner)
{
    const Eigen::Matrix3Xd normal = area_vectors(mesh);
    struct Ends {
        int before = -1, after = -1;
    };
    std::vector<Ends> border(size_t(mesh.vertices()));
    const std::vector<EdgeUse> uses = edge_uses(mesh.triangle);
    for_each_edge(uses, [&](size_t begin, size_t end) {
        const EdgeUse& use = uses[begin];
        if (use.face >= part_faces) // faces stand in their order: both are fill
            return;
        const bool at_border = end == begin + 1 || uses[begin + 1].face >= part_faces;
        if (at_border) {
            const int from = use.forward ? use.low : use.high, to = use.forward ? use.high : use.low;
            border[size_t(from)].after = to;
            border[size_t(to)].before = from;
            return;
        }
        if (number(use.low) == number(use.high) ||
            distance_to_segment(where, mesh.position.col(use.low), mesh.position.col(use.high)) > reach)
            return;
        const double angle = angle_between(normal.col(use.face), normal.col(uses[begin + 1].face));
        if (angle > edge.angle)
            edge = {use.low, use.high, angle};
    });
    for (int v = 0; v < mesh.vertices(); ++v) {
        const Ends& ends = border[size_t(v)];
        if (ends.before < 0 || ends.after < 0 || (mesh.position.col(v) - where).norm() > reach)
            continue;
        const double same = 1e-9 * bounding_diagonal(mesh);
        if (std::any_of(own_corners.begin(), own_corners.end(),
                        [&](const Eigen::Vector3d& own) { return (own - mesh.position.col(v)).norm() <= same; }))
            continue;
        const double angle = angle_between(mesh.position.col(v) - mesh.position.col(ends.before),
                                           mesh.position.col(ends.after) - mesh.position.col(v));
        if (angle > corner.angle)
            corner = {v, -1, angle};
    }
}

} // namespace

FitShortfall find_shortfall(const NurbsSurface& surface, const TriMesh& mesh, const FitOptions& options,
                            const Eigen::Vector3d& where, double reach, double left, FitShortfall::Reason otherwise)
{
    // More than the facets of a fine mesh have; with few data an edge must be sharper to be the
    // reason.
    const double notable = (otherwise == FitShortfall::Reason::data ? 20 : 5) * M_PI / 180;
    const int part_faces = options.part_faces < 0 ? mesh.triangles() : options.part_faces;
    const auto number = [&](int vertex) {
        return vertex < int(options.file_number.size()) ? options.file_number[size_t(vertex)] : vertex;
    };
    Sharpest edge, corner;
    look_around(mesh, part_faces, corners_of(surface), number, where, reach, edge, corner);

    FitShortfall result;
    result.where = where;
    const auto degrees = [](double angle) { return angle * 180 / M_PI; };
    const std::string far =
        fmt::format("the surface deviates by {:.3g} mm where {:.3g} mm are allowed, at ({:.1f}, {:.1f}, {:.1f} mm)",
                    left, options.tolerance, where.x(), where.y(), where.z());
    if (edge.angle >= notable && edge.angle >= 0.5 * corner.angle) {
        result.reason = FitShortfall::Reason::sharp_edge;
        result.a = edge.a;
        result.b = edge.b;
        result.angle = edge.angle;
        result.text =
            fmt::format("{}: a smooth surface rounds the edge {}-{} of the part, a turn of {:.0f} degrees; refine the "
                        "part there, cut it into patches along the edge, or allow more",
                        far, number(edge.a), number(edge.b), degrees(edge.angle));
    } else if (corner.angle >= notable) {
        result.reason = FitShortfall::Reason::outline_corner;
        result.a = corner.a;
        result.angle = corner.angle;
        result.text =
            fmt::format("{}: a smooth border rounds the outline at vertex {}, a turn of {:.0f} degrees; choose it as a "
                        "corner of the grid, cut the part into patches there, or allow more",
                        far, number(corner.a), degrees(corner.angle));
    } else {
        result.reason = otherwise;
        result.text =
            otherwise == FitShortfall::Reason::data
                ? fmt::format("{}: the grid's nodes are too few for more knots; choose a finer grid", far)
                : fmt::format("{}: {} control points are not enough; allow more of them, or a larger tolerance", far,
                              options.max_control_points);
    }
    return result;
}

} // namespace spia
