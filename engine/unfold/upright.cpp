#include "engine/unfold/upright.h"

#include <algorithm>
#include <cmath>
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

/// How far a convex shape reaches in any direction, by the directions of its sides.
class Reach {
public:
    explicit Reach(Eigen::Matrix2Xd hull) : corner_(std::move(hull))
    {
        for (Eigen::Index k = 0; k < corner_.cols(); ++k) { // they rise from -pi on: the first corner is the leftmost
            const Eigen::Vector2d side = corner_.col((k + 1) % corner_.cols()) - corner_.col(k);
            angle_.push_back(std::atan2(side[1], side[0]));
        }
        while (first_ + 1 < angle_.size() && angle_[first_] < angle_[first_ + 1]) // across pi the angles fall once
            ++first_;
        first_ = (first_ + 1) % angle_.size();
        std::rotate(angle_.begin(), angle_.begin() + std::ptrdiff_t(first_), angle_.end());
    }

    double operator()(const Eigen::Vector2d& direction) const
    {
        // The side after the farthest corner is the first one that turns away: its angle is beyond that square to the direction.
        const double square = std::atan2(direction[0], -direction[1]);
        const auto next = std::upper_bound(angle_.begin(), angle_.end(), square) - angle_.begin();
        const auto count = Eigen::Index(angle_.size());
        double most = -std::numeric_limits<double>::infinity();
        for (Eigen::Index beside = -1; beside <= 1; ++beside) // where two are equally far but for rounding
            most = std::max(most, direction.dot(corner_.col((next + Eigen::Index(first_) + beside + count) % count)));
        return most;
    }

private:
    Eigen::Matrix2Xd corner_;
    std::vector<double> angle_; ///< of the sides, rising; the first one is that from corner first_
    size_t first_ = 0;
};

} // namespace

Eigen::Matrix2Xd upright(const std::vector<int>& outline, const Eigen::Matrix2Xd& flat)
{
    const Eigen::Matrix2Xd rim = flat(Eigen::all, outline);
    const Reach reach(convex_hull(rim));
    Eigen::Matrix2d best = Eigen::Matrix2d::Identity();
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < rim.cols(); ++k) {
        const Eigen::Vector2d x = (rim.col((k + 1) % rim.cols()) - rim.col(k)).normalized(), y(-x[1], x[0]);
        const Eigen::Vector2d size(reach(x) + reach(-x), reach(y) + reach(-y));
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
