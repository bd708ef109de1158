#include "engine/exchange/lines/smooth_spline.h"

#include <cmath>
#include <numbers>

namespace spia {
namespace {

bool is_corner(const Eigen::Vector2d& before, const Eigen::Vector2d& at, const Eigen::Vector2d& after)
{
    constexpr double corner = 30 * std::numbers::pi / 180;
    const Eigen::Vector2d u = at - before, v = after - at;
    return std::abs(std::atan2(u[0] * v[1] - u[1] * v[0], u.dot(v))) > corner;
}

/// Of the parabola through three points by chord lengths, at the middle one.
Eigen::Vector2d tangent(const Eigen::Vector2d& before, const Eigen::Vector2d& at, const Eigen::Vector2d& after)
{
    const double h = (at - before).norm(), k = (after - at).norm();
    return (k * (at - before) / h + h * (after - at) / k) / (h + k);
}

/// @param first, last tangents at the ends where the curve goes on smoothly; null: it ends there
SmoothSpline spline_through(const Eigen::Matrix2Xd& p, const Eigen::Vector2d* first, const Eigen::Vector2d* last)
{
    const Eigen::Index count = p.cols();
    SmoothSpline spline;
    if (count == 2 && !first && !last) {
        const double length = (p.col(1) - p.col(0)).norm();
        return {{0, 0, length, length}, {p.col(0), p.col(1)}};
    }
    Eigen::Matrix2Xd t(2, count);
    for (Eigen::Index k = 1; k + 1 < count; ++k)
        t.col(k) = tangent(p.col(k - 1), p.col(k), p.col(k + 1));
    // At an end without a neighbour: that of the parabola whose tangent at the next point is known.
    const auto at_end = [&](Eigen::Index end, Eigen::Index next) -> Eigen::Vector2d {
        const double way = end < next ? 1 : -1;
        const Eigen::Vector2d chord = way * (p.col(next) - p.col(end)) / (p.col(next) - p.col(end)).norm();
        return count > 2 ? Eigen::Vector2d(2 * chord - t.col(next)) : chord;
    };
    t.col(0) = first ? *first : Eigen::Vector2d::Zero();
    t.col(count - 1) = last ? *last : Eigen::Vector2d::Zero();
    if (!first)
        t.col(0) = at_end(0, 1);
    if (!last)
        t.col(count - 1) = at_end(count - 1, count - 2);
    // Cubic pieces between the points; where two meet with one tangent two knots do, and the point
    // itself is no pole.
    double at = 0;
    spline.knots.assign(4, 0);
    spline.poles.emplace_back(p.col(0));
    for (Eigen::Index k = 0; k + 1 < count; ++k) {
        const double h = (p.col(k + 1) - p.col(k)).norm();
        at += h;
        spline.poles.emplace_back(p.col(k) + h / 3 * t.col(k));
        spline.poles.emplace_back(p.col(k + 1) - h / 3 * t.col(k + 1));
        spline.knots.insert(spline.knots.end(), k + 2 < count ? 2 : 4, at);
    }
    spline.poles.emplace_back(p.col(count - 1));
    return spline;
}

} // namespace

std::vector<SmoothSpline> smooth_splines(const Eigen::Matrix2Xd& points, bool closed)
{
    const Eigen::Index count = points.cols();
    const auto at = [&](Eigen::Index k) -> Eigen::Vector2d { return points.col((k + count) % count); };
    std::vector<Eigen::Index> corners;
    for (Eigen::Index k = closed ? 0 : 1; k < (closed ? count : count - 1); ++k)
        if (is_corner(at(k - 1), at(k), at(k + 1)))
            corners.push_back(k);
    const auto run = [&](Eigen::Index from, Eigen::Index to) {
        Eigen::Matrix2Xd part(2, to - from + 1);
        for (Eigen::Index k = from; k <= to; ++k)
            part.col(k - from) = at(k);
        return part;
    };
    std::vector<SmoothSpline> splines;
    if (closed && corners.empty()) {
        const Eigen::Vector2d around = tangent(at(-1), at(0), at(1));
        return {spline_through(run(0, count), &around, &around)};
    }
    std::vector<Eigen::Index> ends;
    if (!closed)
        ends.push_back(0);
    ends.insert(ends.end(), corners.begin(), corners.end());
    ends.push_back(closed ? corners.front() + count : count - 1);
    for (size_t k = 0; k + 1 < ends.size(); ++k)
        splines.push_back(spline_through(run(ends[k], ends[k + 1]), nullptr, nullptr));
    return splines;
}

} // namespace spia
