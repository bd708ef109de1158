#include "engine/nurbs/equidistributed_spans.h"

#include <algorithm>
#include <cmath>

#include "engine/nurbs/basis.h"

namespace spia {
namespace {

/// The highest derivative in each span, where it is constant.
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

/// Per inner knot how far that derivative steps there, the largest of all rows.
std::vector<double> steps_at_knots(const NurbsSurface& surface, bool along_u)
{
    const std::vector<double>& knots = along_u ? surface.knots_u : surface.knots_v;
    const int degree = along_u ? surface.degree_u : surface.degree_v;
    const int count = along_u ? surface.count_u : surface.count_v, across = along_u ? surface.count_v : surface.count_u;
    std::vector<double> result(span_borders(knots, degree).size() - 2, 0);
    for (int r = 0; r < across; ++r) {
        Eigen::Matrix3Xd row(3, count);
        for (int i = 0; i < count; ++i)
            row.col(i) = surface.control.col(along_u ? surface.index(i, r) : surface.index(r, i));
        const Eigen::Matrix3Xd top = highest_derivative(knots, degree, row);
        for (size_t k = 0; k < result.size(); ++k)
            result[k] = std::max(result[k], (top.col(Eigen::Index(k) + 1) - top.col(Eigen::Index(k))).norm());
    }
    return result;
}

} // namespace

std::vector<double> knot_significance(const NurbsSurface& surface, bool along_u)
{
    const int degree = along_u ? surface.degree_u : surface.degree_v;
    const std::vector<double> border = span_borders(along_u ? surface.knots_u : surface.knots_v, degree);
    std::vector<double> result = steps_at_knots(surface, along_u);
    for (size_t k = 0; k < result.size(); ++k) {
        const double before = border[k + 1] - border[k], after = border[k + 2] - border[k + 1];
        result[k] *= std::pow(before * after / (before + after), degree);
    }
    return result;
}

std::vector<double> equidistributed_spans(const NurbsSurface& surface, bool along_u, int spans)
{
    const int degree = along_u ? surface.degree_u : surface.degree_v;
    const std::vector<double> border = span_borders(along_u ? surface.knots_u : surface.knots_v, degree);
    const std::vector<double> step = steps_at_knots(surface, along_u);
    const size_t n = border.size() - 1;
    std::vector<double> density(n, 0);
    for (size_t k = 0; k < step.size(); ++k) { // of the steps to both neighbours the larger
        const double slope = step[k] / ((border[k + 2] - border[k]) / 2);
        density[k] = std::max(density[k], slope);
        density[k + 1] = std::max(density[k + 1], slope);
    }
    double whole = 0;
    for (size_t s = 0; s < n; ++s) {
        density[s] = std::pow(density[s], 1. / (degree + 1));
        whole += density[s] * (border[s + 1] - border[s]);
    }
    constexpr double least = 0.1; // of the mean: a span is not to be without any end where nothing
                                  // is seen to happen
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
