#include "engine/part/stated_curvature.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "engine/mesh/curvature.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

/// Per vertex, whether it lies on planes and cylinders alone whose normals are the same there.
std::vector<char> on_bends(const PartFile& part)
{
    constexpr double smooth = 1 - 1e-6; // cosine, 0.08 degrees: gaps of CAD files
    const Eigen::Matrix3Xd normal = area_vectors(part.mesh);
    std::vector<char> result(size_t(part.mesh.vertices()), 1);
    Eigen::Matrix3Xd first = Eigen::Matrix3Xd::Zero(3, part.mesh.vertices());
    for (int f = 0; f < part.mesh.triangles(); ++f) {
        const StatedSurface& surface = part.cad->surface[size_t(part.cad->face[size_t(part.source_face[size_t(f)])])];
        for (const int v : part.mesh.triangle.col(f)) {
            if (surface.kind == StatedSurface::Kind::other) {
                result[size_t(v)] = 0;
                continue;
            }
            const Eigen::Vector3d here = normal_at(surface, part.mesh.position.col(v), normal.col(f).normalized());
            if (first.col(v).isZero())
                first.col(v) = here;
            result[size_t(v)] &= first.col(v).dot(here) >= smooth;
        }
    }
    return result;
}

} // namespace

double curvature_off_bends(const PartFile& part)
{
    const Eigen::VectorXd defect = angle_defects(part.mesh);
    if (!part.cad || part.cad->surface.empty())
        return defect.cwiseAbs().sum();
    const std::vector<char> bend = on_bends(part);
    double sum = 0;
    for (int v = 0; v < part.mesh.vertices(); ++v)
        sum += bend[size_t(v)] ? 0 : std::abs(defect[v]);
    return sum;
}

} // namespace spia
