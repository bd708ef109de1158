#include "engine/mesh/solid/border/along_rulings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/mesh/solid/border/sheet_section.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Per vertex of a middle surface the axis of the cylinder that it lies on, unit, away from the
/// surface; zero: on none, or on more than one.
Eigen::Matrix3Xd rulings(const SkinMesh& middle, const std::vector<StatedSurface>& under)
{
    const TriMesh& mesh = middle.mesh;
    Eigen::Matrix3Xd axis = Eigen::Matrix3Xd::Zero(3, mesh.vertices()), away = axis;
    std::vector<char> several(size_t(mesh.vertices()), 0);
    for (int f = 0; f < mesh.triangles(); ++f) {
        const Eigen::Vector3d centre = mesh.position(Eigen::all, mesh.triangle.col(f)).rowwise().mean();
        const StatedSurface& surface = under[size_t(middle.source_face[size_t(f)])];
        constexpr double parallel = 1 - 1e-6; // 0.1 degrees
        for (const int v : mesh.triangle.col(f)) {
            away.col(v) += mesh.position.col(v) - centre;
            if (surface.kind != StatedSurface::Kind::cylinder)
                continue;
            several[size_t(v)] |= !axis.col(v).isZero() && std::abs(axis.col(v).dot(surface.direction)) < parallel;
            axis.col(v) = surface.direction;
        }
    }
    for (int v = 0; v < mesh.vertices(); ++v)
        axis.col(v) *= several[size_t(v)] ? 0 : axis.col(v).dot(away.col(v)) < 0 ? -1 : 1;
    return axis;
}

/// Where triangles have turned over, their vertices go back to where they were.
void put_back_folds(TriMesh& mesh, const Eigen::Matrix3Xd& before)
{
    const Eigen::Matrix3Xd facing = area_vectors({before, mesh.triangle});
    for (bool any = true; any;) {
        any = false;
        const Eigen::Matrix3Xd now = area_vectors(mesh);
        for (int f = 0; f < mesh.triangles(); ++f)
            if (now.col(f).dot(facing.col(f)) <= 0)
                for (const int v : mesh.triangle.col(f)) {
                    any |= mesh.position.col(v) != before.col(v);
                    mesh.position.col(v) = before.col(v);
                }
    }
}

} // namespace

TriMesh along_rulings(const SkinMesh& middle, const std::vector<BesideLoop>& loops,
                      const std::vector<StatedSurface>& under, const GivenSolid& solid, double tolerance)
{
    TriMesh mesh = middle.mesh;
    const Eigen::Matrix3Xd ruling = rulings(middle, under);
    const SheetSection section(solid.mesh, solid.thickness);
    const Eigen::Matrix3Xd normal = vertex_normals(mesh);
    const Eigen::Matrix3Xd before = mesh.position;
    for (const BesideLoop& loop : loops)
        for (size_t i = 0; i < loop.vertex.size(); ++i) {
            const size_t n = loop.vertex.size();
            const int v = loop.vertex[i];
            if (loop.beside[2 * i] == 0 || ruling.col(v).isZero())
                continue;
            const auto along = [&](int from, int to) {
                return std::abs((before.col(to) - before.col(from)).normalized().dot(ruling.col(v)));
            };
            // cosine of 30 degrees; thicknesses: chamfers and roundings take less
            constexpr double crosses = 0.87, most = 1;
            constexpr int digits = 40;
            if (std::max(along(loop.vertex[(i + n - 1) % n], v), along(v, loop.vertex[(i + 1) % n])) > crosses)
                continue;
            const double end = section.to_the_end({before.col(v), normal.col(v), ruling.col(v)}, tolerance,
                                                  most * solid.thickness, digits);
            const Eigen::Vector3d to = before.col(v) + end * ruling.col(v);
            if (std::abs(end) < most * solid.thickness &&
                section.square_wall({to, normal.col(v), ruling.col(v)}, tolerance))
                mesh.position.col(v) = to;
        }
    put_back_folds(mesh, before);
    return mesh;
}

} // namespace spia
