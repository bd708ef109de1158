#pragma once
#include <array>
#include <vector>

namespace spia {

/// The highest degree that is evaluated; what others read from files we have not seen go beyond 7.
constexpr int max_degree = 9;

/// The degree + 1 B-spline functions that do not vanish at one parameter, with their derivatives.
/// Entry k belongs to function (and control point) first + k.
struct BasisValues {
    int first = 0;
    std::array<double, max_degree + 1> value{};
    std::array<double, max_degree + 1> first_derivative{};
    std::array<double, max_degree + 1> second_derivative{};
};

/// The span [knots[s], knots[s + 1]) of non-zero length that holds u; the last one for u at the end
/// of the domain or beyond, the first one for u before it.
/// @param knots clamped: degree + 1 equal values at each end, non-decreasing, the ends distinct
int find_span(const std::vector<double>& knots, int degree, double u);

/// @param u inside the domain [knots[degree], knots[size - degree - 1]]; no allocation. [NURBS
/// Book, eqs. 2.5, 2.7]
BasisValues basis(const std::vector<double>& knots, int degree, double u);

/// The distinct knots of the domain in rising order: the borders of its spans.
std::vector<double> span_borders(const std::vector<double>& knots, int degree);

/// Knots, or borders of spans, from 0 to 1 of a curve that runs the other way. Exact for dyadic
/// ones.
std::vector<double> mirrored(std::vector<double> knots);

} // namespace spia
