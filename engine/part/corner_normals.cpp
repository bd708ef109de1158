#include "engine/part/corner_normals.h"

#include <cmath>
#include <limits>

namespace spia {

Eigen::Vector3d CornerNormals::at(int triangle, const Eigen::Vector3d& place, const Eigen::Vector3d& own) const
{
    const auto corners = soup_.polygon(triangle);
    size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < 3; ++k)
        if (const double way = (soup_.position[size_t(corners[k])] - place).squaredNorm(); way < least) {
            least = way;
            nearest = k;
        }
    return at_corner(triangle, int(nearest), own).value_or(own);
}

std::optional<Eigen::Vector3d> CornerNormals::at_corner(int triangle, int corner, const Eigen::Vector3d& own) const
{
    const Eigen::Vector3d normal = normal_[size_t(triangle)][size_t(corner)].cast<double>().normalized();
    constexpr double askew = 0.2; // 78 degrees
    const double along = normal.dot(own);
    if (!(std::abs(along) > askew))
        return std::nullopt;
    return along > 0 ? normal : Eigen::Vector3d(-normal);
}

} // namespace spia
