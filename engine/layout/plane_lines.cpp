#include "engine/layout/plane_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/mesh/nearest_share.h"
#include "engine/mesh/orient2d.h"

namespace spia {

double turn_to(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
    const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
    const Eigen::Vector2d way = b - a;
    return (a + nearest_share(p, a, way) * way - p).norm();
}

bool segments_meet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                   const Eigen::Vector2d& d)
{
    for (int k = 0; k < 2; ++k)
        if (std::max(a[k], b[k]) < std::min(c[k], d[k]) || std::max(c[k], d[k]) < std::min(a[k], b[k]))
            return false;
    return orient2d(a, b, c) * orient2d(a, b, d) <= 0 && orient2d(c, d, a) * orient2d(c, d, b) <= 0;
}

bool leads_inside(const Eigen::Vector2d& before, const Eigen::Vector2d& v, const Eigen::Vector2d& after,
                  const Eigen::Vector2d& q)
{
    const bool left_of_first = orient2d(before, v, q) > 0, left_of_second = orient2d(v, after, q) > 0;
    return orient2d(before, v, after) > 0 ? left_of_first && left_of_second : left_of_first || left_of_second;
}

} // namespace spia
