#include "engine/unfold/upright.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "engine/mesh/orient2d.h"

namespace spia {
namespace {

/// The corners of the smallest convex shape around some places, counter-clockwise. [Andrew 1979]
Eigen::Matrix2Xd convex_hull(const Eigen::Matrix2Xd& places)
{
    std::vector<Eigen::Index> order(size_t(places.cols()));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
        return places(0, a) < places(0, b) || (places(0, a) == places(0, b) && places(1, a) < places(1, b));
    });
    std::vector<Eigen::Index> hull;
    const auto chain = [&](auto from, auto to) {
        const size_t first = hull.size();
        for (; from != to; ++from) {
            while (hull.size() >= first + 2 &&
                   orient2d(places.col(hull[hull.size() - 2]), places.col(hull.back()), places.col(*from)) <= 0)
                hull.pop_back();
            hull.push_back(*from);
        }
        hull.pop_back(); // the other chain begins with it
    };
    chain(order.begin(), order.end());
    chain(order.rbegin(), order.rend());
    return places(Eigen::all, hull);
}

} // namespace

Eigen::Matrix2Xd upright(const std::vector<int>& outline, const Eigen::Matrix2Xd& flat)
{
    const Eigen::Matrix2Xd rim = flat(Eigen::all, outline);
    const Eigen::Matrix2Xd hull = convex_hull(rim); // far fewer places, most often
    const auto width = [&](const Eigen::Vector2d& direction) {
        const Eigen::RowVectorXd along = direction.transpose() * hull;
        return along.maxCoeff() - along.minCoeff();
    };
    Eigen::Matrix2d best = Eigen::Matrix2d::Identity();
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < rim.cols(); ++k) {
        const Eigen::Vector2d x = (rim.col((k + 1) % rim.cols()) - rim.col(k)).normalized(), y(-x[1], x[0]);
        const Eigen::Vector2d size(width(x), width(y));
        if (size.prod() >= least * (1 - 1e-9))
            continue;
        Eigen::Matrix2d turn;
        turn << x.transpose(), y.transpose();
        least = size.prod();
        best = size[0] >= size[1] ? turn : Eigen::Matrix2d((Eigen::Matrix2d() << 0, 1, -1, 0).finished() * turn);
    }
    return best * flat;
}

} // namespace spia
