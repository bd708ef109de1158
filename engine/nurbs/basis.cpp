#include "engine/nurbs/basis.h"

#include <algorithm>
#include <cassert>

namespace spia {

namespace {

using Row = std::array<double, max_degree + 1>;

/// From the functions of degree d - 1 that do not vanish on the span to those of degree d. Entry k
/// of a row of degree d belongs to function span - d + k. No denominator is zero: each is the
/// length of the support of a function that does not vanish on the span.
Row raise(const Row& lower, const double* knot_of_span, int d, double u)
{
    Row higher{};
    for (int k = 0; k < d; ++k) { // lower[k] rises over [a, b] into higher[k + 1] and falls into
                                  // higher[k]
        const double a = knot_of_span[k - d + 1], b = knot_of_span[k + 1];
        const double share = lower[size_t(k)] / (b - a);
        higher[size_t(k)] += (b - u) * share;
        higher[size_t(k) + 1] = (u - a) * share;
    }
    return higher;
}

/// The derivatives of the functions of degree d from the functions of degree d - 1; from the
/// derivatives of those, the next higher derivatives.
Row raise_derivative(const Row& lower, const double* knot_of_span, int d)
{
    Row higher{};
    for (int k = 0; k < d; ++k) {
        const double share = d * lower[size_t(k)] / (knot_of_span[k + 1] - knot_of_span[k - d + 1]);
        higher[size_t(k)] -= share;
        higher[size_t(k) + 1] = share;
    }
    return higher;
}

} // namespace

int find_span(const std::vector<double>& knots, int degree, double u)
{
    const auto from = knots.begin() + degree, to = knots.end() - degree - 1;
    assert(from < to && *from < *to);
    // At the end of the domain, and beyond, the half-open rule would give a span of no length.
    const auto after = u >= *to ? std::lower_bound(from, to, *to) : std::upper_bound(from, to, std::max(u, *from));
    return int(after - knots.begin()) - 1;
}

BasisValues basis(const std::vector<double>& knots, int degree, double u)
{
    assert(degree >= 1 && degree <= max_degree);
    const int span = find_span(knots, degree, u);
    const double* knot = knots.data() + span;
    BasisValues result;
    result.first = span - degree;
    Row row{};
    row[0] = 1;
    for (int d = 1; d < degree - 1; ++d)
        row = raise(row, knot, d, u);
    // row now has degree max(0, degree - 2)
    if (degree >= 2) {
        result.second_derivative = raise_derivative(raise_derivative(row, knot, degree - 1), knot, degree);
        row = raise(row, knot, degree - 1, u);
    }
    result.first_derivative = raise_derivative(row, knot, degree);
    result.value = raise(row, knot, degree, u);
    return result;
}

std::vector<double> span_borders(const std::vector<double>& knots, int degree)
{
    std::vector<double> borders(knots.begin() + degree, knots.end() - degree);
    borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
    return borders;
}

std::vector<double> mirrored(std::vector<double> knots)
{
    std::reverse(knots.begin(), knots.end());
    for (double& knot : knots)
        knot = 1 - knot;
    return knots;
}

} // namespace spia
