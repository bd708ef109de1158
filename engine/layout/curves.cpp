#include <algorithm>
#include <cmath>

#include "engine/layout/layout.h"

namespace spia {

namespace {

/// Lengths on the blank from the start to each point.
std::vector<double> lengths(const LayoutCurve& curve)
{
    std::vector<double> result = {0};
    for (Eigen::Index i = 1; i < curve.plane.cols(); ++i)
        result.push_back(result.back() + (curve.plane.col(i) - curve.plane.col(i - 1)).norm());
    return result;
}

template <class Points> Points at_shares(const LayoutCurve& curve, const Points& points, const std::vector<double>& t)
{
    const std::vector<double> start = lengths(curve);
    Points result(points.rows(), Eigen::Index(t.size()));
    for (size_t i = 0; i < t.size(); ++i) {
        const double s = t[i] * start.back();
        const size_t next = size_t(std::clamp<long>(std::upper_bound(start.begin(), start.end(), s) - start.begin(), 1,
                                                    long(start.size()) - 1));
        const double piece = start[next] - start[next - 1];
        const double share = piece > 0 ? std::clamp((s - start[next - 1]) / piece, 0.0, 1.0) : 0;
        result.col(Eigen::Index(i)) =
            (1 - share) * points.col(Eigen::Index(next) - 1) + share * points.col(Eigen::Index(next));
        if (t[i] == 0)
            result.col(Eigen::Index(i)) = points.col(0);
        if (t[i] == 1)
            result.col(Eigen::Index(i)) = points.col(points.cols() - 1);
    }
    return result;
}

} // namespace

Eigen::Matrix2Xd points_on(const LayoutCurve& curve, const std::vector<double>& t)
{
    return at_shares(curve, curve.plane, t);
}

Eigen::Matrix3Xd part_points_on(const LayoutCurve& curve, const std::vector<double>& t)
{
    return at_shares(curve, curve.part, t);
}

double length(const LayoutCurve& curve) { return lengths(curve).back(); }

PatchPolygon polygon_of(const Layout& layout, const LayoutPatch& patch, int pieces)
{
    PatchPolygon result;
    std::vector<Eigen::Vector2d> points;
    for (size_t k = 0; k < 4; ++k) {
        const LayoutCurve& curve = layout.curve[size_t(patch[k].curve)];
        result.corner[k] = int(points.size());
        const double longest = length(curve) / pieces;
        std::vector<Eigen::Vector2d> side;
        for (Eigen::Index i = 0; i + 1 < curve.plane.cols(); ++i) {
            const Eigen::Vector2d a = curve.plane.col(i), b = curve.plane.col(i + 1);
            const int parts = std::max(1, int(std::ceil((b - a).norm() / longest - 1e-6)));
            for (int n = 0; n < parts; ++n)
                side.push_back(a + (b - a) * (double(n) / parts));
        }
        side.push_back(curve.plane.col(curve.plane.cols() - 1));
        if (patch[k].reversed)
            std::reverse(side.begin(), side.end());
        points.insert(points.end(), side.begin(), side.end() - 1);
    }
    result.point.resize(2, Eigen::Index(points.size()));
    for (size_t i = 0; i < points.size(); ++i)
        result.point.col(Eigen::Index(i)) = points[i];
    return result;
}

double area(const Layout& layout, const LayoutPatch& patch)
{
    const Eigen::Matrix2Xd p = polygon_of(layout, patch).point;
    double twice = 0;
    for (Eigen::Index i = 0, j = p.cols() - 1; i < p.cols(); j = i++)
        twice += p(0, j) * p(1, i) - p(0, i) * p(1, j);
    return twice / 2;
}

} // namespace spia
