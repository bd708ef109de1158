#include "engine/forming/solver/seen_along.h"

#include <algorithm>
#include <cmath>

#include "engine/mesh/topology.h"

namespace spia {

StampingDirection seen_along(const TriMesh& part, const Eigen::Vector3d& direction)
{
    StampingDirection given{direction.normalized(), 0, true, 0};
    double hidden = 0, area = 0;
    const Eigen::Matrix3Xd area_vector = area_vectors(part);
    if (area_vector.rowwise().sum().dot(given.direction) < 0)
        given.direction *= -1;
    for (int f = 0; f < part.triangles(); ++f) {
        const double size = area_vector.col(f).norm(), cosine = area_vector.col(f).dot(given.direction) / size;
        given.steepest_angle = std::max(given.steepest_angle, std::acos(std::clamp(cosine, -1.0, 1.0)));
        hidden += cosine <= 0 ? size : 0;
        area += size;
    }
    given.height_field = hidden == 0;
    given.hidden_area_fraction = hidden / area;
    return given;
}

} // namespace spia
