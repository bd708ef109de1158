#include "engine/nurbs/foot_point_projection.h"

#include <Eigen/Geometry>
#include <cmath>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/mesh/topology.h"

namespace spia {

namespace {

/// The boundary as faces without area: a search finds places on their edges.
TriMesh boundary_of(const TriMesh& part)
{
    TriMesh result;
    result.position = part.position;
    std::vector<Eigen::Vector3i> edges;
    for (const std::vector<int>& loop : boundary_loops(part))
        for (size_t i = 0; i < loop.size(); ++i) {
            const int next = loop[(i + 1) % loop.size()];
            edges.emplace_back(loop[i], next, next);
        }
    if (edges.empty())
        throw InputError("the part has no boundary along which the border of a surface could slide");
    result.triangle.resize(3, Eigen::Index(edges.size()));
    for (size_t e = 0; e < edges.size(); ++e)
        result.triangle.col(Eigen::Index(e)) = edges[e];
    return result;
}

} // namespace

FootPointProjection::FootPointProjection(const TriMesh& part)
    : face_normal_(area_vectors(part)), inside_(part), boundary_(boundary_of(part))
{
    face_normal_.colwise().normalize();
}

std::vector<SurfacePoint> FootPointProjection::project_points(const NurbsSurface& surface, const std::vector<double>& u,
                                                              const std::vector<double>& v,
                                                              Eigen::Matrix3Xd& points) const
{
    std::vector<SurfacePoint> on_surface(size_t(points.cols()));
    const int columns = int(u.size()), rows = int(v.size());
    parallel_for(columns * rows, [&](int n) {
        const int i = n % columns, j = n / columns;
        const bool at_u = i == 0 || i == columns - 1, at_v = j == 0 || j == rows - 1;
        const SurfacePoint& at = on_surface[size_t(n)] = evaluate(surface, u[size_t(i)], v[size_t(j)]);
        if (at_u && at_v)
            return;
        const double missed = (points.col(n) - at.position).norm();
        const ClosestPoint foot =
            at_u || at_v ? boundary_.nearest(at.position, 2 * missed) : inside_.nearest(at.position, 2 * missed);
        if (foot.face < 0 || foot.distance > missed)
            return;
        if (at_u || at_v || std::abs(at.normal().dot(face_normal_.col(foot.face))) > 0.5)
            points.col(n) = foot.position;
    });
    return on_surface;
}

} // namespace spia
