#include "app/viewer/model/reports/point_cloud.h"

#include <algorithm>

namespace spia::viewer {

PointCloud count_points(const Eigen::VectorXd& x, const Eigen::VectorXd& y, const Eigen::VectorXi& marked,
                        const Eigen::AlignedBox2d& range, int columns, int rows)
{
    std::vector<PointCloud::Square> all(size_t(columns) * size_t(rows));
    const Eigen::Vector2d size = range.sizes();
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        const Eigen::Vector2d at(x[k], y[k]);
        if (!range.contains(at))
            continue;
        const Eigen::Vector2d share = (at - range.min()).cwiseQuotient(size);
        const int column = std::min(columns - 1, int(share[0] * columns)),
                  row = std::min(rows - 1, int(share[1] * rows));
        PointCloud::Square& square = all[size_t(row) * size_t(columns) + size_t(column)];
        ++square.points;
        square.marked += marked[k] != 0;
    }
    PointCloud cloud;
    for (size_t k = 0; k < all.size(); ++k)
        if (all[k].points > 0) {
            cloud.squares.push_back({int(k) % columns, int(k) / columns, all[k].points, all[k].marked});
            cloud.most = std::max(cloud.most, all[k].points);
        }
    return cloud;
}

std::optional<int> nearest_point(const Eigen::VectorXd& x, const Eigen::VectorXd& y, const Eigen::Vector2d& at,
                                 const Eigen::Vector2d& reach)
{
    std::optional<int> nearest;
    double least = 1;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        const double distance = (Eigen::Vector2d(x[k], y[k]) - at).cwiseQuotient(reach).squaredNorm();
        if (distance < least || (!nearest && distance <= least)) {
            least = distance;
            nearest = int(k);
        }
    }
    return nearest;
}

std::vector<int> points_within(const Eigen::VectorXd& x, const Eigen::VectorXd& y, const Eigen::AlignedBox2d& box)
{
    std::vector<int> inside;
    for (Eigen::Index k = 0; k < x.size(); ++k)
        if (box.contains(Eigen::Vector2d(x[k], y[k])))
            inside.push_back(int(k));
    return inside;
}

} // namespace spia::viewer
