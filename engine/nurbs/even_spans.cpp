#include "engine/nurbs/even_spans.h"

#include <algorithm>
#include <cmath>

#include "engine/nurbs/basis.h"

namespace spia {
namespace {

/// Largest size of the highest derivative in each span, over all rows of control points across: it is constant there.
Eigen::Matrix3Xd highest_derivative(const std::vector<double>& knots, int degree, Eigen::Matrix3Xd control)
{
    // [NURBS Book, A3.3]: differences of the control points, one degree after the other
    for (int k = 1; k <= degree; ++k) {
        Eigen::Matrix3Xd next(3, control.cols() - 1);
        for (Eigen::Index i = 0; i < next.cols(); ++i) {
            const double width = knots[size_t(i) + size_t(degree) + 1] - knots[size_t(i) + size_t(k)];
            next.col(i) = width > 0 ? Eigen::Vector3d((degree - k + 1) * (control.col(i + 1) - control.col(i)) / width)
                                    : Eigen::Vector3d(Eigen::Vector3d::Zero());
        }
        control = std::move(next);
    }
    return control; // one per span of single inner knots
}

} // namespace

std::vector<double> even_spans(const NurbsSurface& surface, bool along_u, int spans)
{
    const std::vector<double>& knots = along_u ? surface.knots_u : surface.knots_v;
    const int degree = along_u ? surface.degree_u : surface.degree_v;
    const int count = along_u ? surface.count_u : surface.count_v, across = along_u ? surface.count_v : surface.count_u;
    const std::vector<double> border = span_borders(knots, degree);
    const size_t n = border.size() - 1;
    std::vector<double> density(n, 0);
    for (int r = 0; r < across; ++r) {
        Eigen::Matrix3Xd row(3, count);
        for (int i = 0; i < count; ++i)
            row.col(i) = surface.control.col(along_u ? surface.index(i, r) : surface.index(r, i));
        const Eigen::Matrix3Xd top = highest_derivative(knots, degree, row);
        const auto middle = [&](size_t s) { return (border[s] + border[s + 1]) / 2; };
        for (size_t s = 0; s < n; ++s) { // of the steps to both neighbours the larger
            double step = 0;
            for (const size_t other : {s > 0 ? s - 1 : s, s + 1 < n ? s + 1 : s})
                if (other != s)
                    step = std::max(step, (top.col(Eigen::Index(other)) - top.col(Eigen::Index(s))).norm() /
                                              std::abs(middle(other) - middle(s)));
            density[s] = std::max(density[s], step);
        }
    }
    double whole = 0;
    for (size_t s = 0; s < n; ++s) {
        density[s] = std::pow(density[s], 1. / (degree + 1));
        whole += density[s] * (border[s + 1] - border[s]);
    }
    constexpr double least = 0.1; // of the mean: a span is not to be without any end where nothing is seen to happen
    double sum = 0;
    for (double& d : density)
        d = whole > 0 ? std::max(d, least * whole) : 1;
    for (size_t s = 0; s < n; ++s)
        sum += density[s] * (border[s + 1] - border[s]);
    std::vector<double> result = {0};
    double before = 0;
    size_t s = 0;
    for (int k = 1; k < spans; ++k) {
        const double wanted = sum * k / spans;
        while (s + 1 < n && before + density[s] * (border[s + 1] - border[s]) < wanted)
            before += density[s] * (border[s + 1] - border[s]), ++s;
        result.push_back(border[s] + (wanted - before) / density[s]);
    }
    result.push_back(1);
    return result;
}

} // namespace spia
