#include "engine/mesh/flat/inside_polygon.h"

#include "engine/mesh/orient2d.h"

namespace spia {

bool inside_polygon(const Eigen::Matrix2Xd& polygon, const Eigen::Vector2d& point)
{
    bool inside = false;
    for (Eigen::Index i = 0, j = polygon.cols() - 1; i < polygon.cols(); j = i++) {
        const Eigen::Vector2d a = polygon.col(j), b = polygon.col(i);
        if ((a.y() > point.y()) == (b.y() > point.y()))
            continue;
        const int side = orient2d(a, b, point);
        if (b.y() > a.y() ? side > 0 : side < 0)
            inside = !inside;
    }
    return inside;
}

} // namespace spia
