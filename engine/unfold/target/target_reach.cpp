#include "engine/unfold/target/target_reach.h"

#include <algorithm>

#include "engine/mesh/closest_point.h"

namespace spia {

TargetReach target_reach(const TriMesh& now, const std::vector<int>& carrying, const std::vector<int>& laid,
                         const std::optional<double>& extent_mm)
{
    constexpr double rounding = 1e-9; // of the extent
    const ClosestPointSearch search({now.position, now.triangle(Eigen::all, carrying)});
    Eigen::VectorXd away = Eigen::VectorXd::Constant(now.vertices(), -1);
    TargetReach reach;
    for (const int f : laid) {
        double farthest = 0;
        for (const int v : now.triangle.col(f)) {
            if (away[v] < 0)
                away[v] = search.nearest(now.position.col(v)).distance;
            farthest = std::max(farthest, away[v]);
        }
        reach.farthest_mm = std::max(reach.farthest_mm, farthest);
        reach.without_room += extent_mm && farthest > (1 + rounding) * *extent_mm;
    }
    return reach;
}

} // namespace spia
