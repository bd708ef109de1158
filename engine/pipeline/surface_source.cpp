#include "engine/pipeline/surface_source.h"

#include <algorithm>
#include <numbers>

#include "engine/mesh/smooth/smooth_normals.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Normals at the corners of triangles that CAD faces give: exact ones of planes and cylinders.
std::vector<Eigen::Matrix3f> known_normals(const PartFile& part)
{
    std::vector<Eigen::Matrix3f> normal = part.corner_normal;
    if (!part.cad || part.cad->surface.empty() || normal.empty())
        return normal;
    const Eigen::Matrix3Xd own = area_vectors(part.mesh);
    for (int f = 0; f < part.mesh.triangles(); ++f) {
        const StatedSurface& surface = part.cad->surface[size_t(part.cad->face[size_t(part.source_face[size_t(f)])])];
        for (int k = 0; k < 3 && surface.kind != StatedSurface::Kind::other; ++k)
            normal[size_t(f)].col(k) =
                normal_at(surface, part.mesh.position.col(part.mesh.triangle(k, f)), own.col(f).normalized())
                    .cast<float>();
    }
    return normal;
}

SmoothMeshOptions sheet_options(double tolerance, double edge_deg)
{
    SmoothMeshOptions options;
    constexpr double share = 0.1;
    options.chord = share * tolerance;
    options.crease = std::min(options.crease, edge_deg * std::numbers::pi / 180);
    return options;
}

} // namespace

SurfaceSource surface_source(const PartFile& part, double tolerance, double edge_deg)
{
    SurfaceSource result;
    result.sheet = smooth_mesh(part.mesh, sheet_options(tolerance, edge_deg), known_normals(part));
    result.part_faces = result.sheet.mesh.triangles();
    result.facets_off = result.sheet.chord;
    return result;
}

SurfaceSource surface_source(const PartFile& part, const FilledMesh& filled, double tolerance, double edge_deg)
{
    SmoothMeshOptions options = sheet_options(tolerance, edge_deg);
    const std::vector<Eigen::Matrix3d> own = smooth_normals(part.mesh, options.crease, known_normals(part));
    std::vector<Eigen::Matrix3f> given(size_t(filled.mesh.triangles()), Eigen::Matrix3f::Zero());
    std::ranges::transform(own, given.begin(),
                           [](const Eigen::Matrix3d& normal) { return Eigen::Matrix3f(normal.cast<float>()); });
    SurfaceSource result;
    result.sheet = smooth_mesh(filled.mesh, options, given);
    result.part_faces = int(std::ranges::count_if(result.sheet.face, [&](int f) { return !filled.is_fill(f); }));
    options.most_halvings = 0;
    result.facets_off = smooth_mesh(part.mesh, options, known_normals(part)).chord;
    return result;
}

std::vector<int> nearest_vertices(const SmoothMesh& sheet, const TriMesh& from)
{
    std::vector<int> result(size_t(sheet.mesh.vertices()));
    for (int t = 0; t < sheet.mesh.triangles(); ++t)
        for (int k = 0; k < 3; ++k) {
            int nearest;
            sheet.barycentric[size_t(t)].col(k).maxCoeff(&nearest);
            result[size_t(sheet.mesh.triangle(k, t))] = from.triangle(nearest, sheet.face[size_t(t)]);
        }
    return result;
}

} // namespace spia
