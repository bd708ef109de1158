#include "engine/nurbs/bezier.h"

#include <Eigen/Geometry>
#include <array>

#include "engine/nurbs/basis.h"

namespace spia {

namespace {

/// Products of three derivatives of the highest degree.
constexpr int most = 3 * max_degree + 1;

/// Pascal's triangle.
const std::array<std::array<double, most>, most>& choose()
{
    static const auto table = [] {
        std::array<std::array<double, most>, most> result{};
        for (size_t n = 0; n < most; ++n)
            for (size_t k = 0; k <= n; ++k)
                result[n][k] = k == 0 || k == n ? 1 : result[n - 1][k - 1] + result[n - 1][k];
        return result;
    }();
    return table;
}

double binomial(int n, int k) { return choose()[size_t(n)][size_t(k)]; }

/// Row k of the result: weights of the degree + 1 control points of a span in its Bezier
/// coefficient k.
Eigen::MatrixXd extraction(const std::vector<double>& knots, int degree, int span)
{
    const double* knot = knots.data() + span;
    Eigen::MatrixXd result(degree + 1, degree + 1);
    for (int k = 0; k <= degree; ++k) { // the blossom at k times the end and degree - k times the
                                        // beginning
        Eigen::MatrixXd d = Eigen::MatrixXd::Identity(degree + 1, degree + 1);
        for (int r = 1; r <= degree; ++r) {
            const double argument = r <= k ? knot[1] : knot[0];
            for (int i = degree; i >= r; --i) {
                const double low = knot[i - degree], high = knot[1 + i - r], share = (argument - low) / (high - low);
                d.row(i) = (1 - share) * d.row(i - 1) + share * d.row(i);
            }
        }
        result.row(k) = d.row(degree);
    }
    return result;
}

/// @param combine of a coefficient of f and one of g
template <class Combine>
BezierPatch product(const BezierPatch& f, const BezierPatch& g, Eigen::Index dimension, const Combine& combine)
{
    BezierPatch result;
    result.degree_s = f.degree_s + g.degree_s;
    result.degree_t = f.degree_t + g.degree_t;
    result.coefficient.setZero(dimension, (result.degree_s + 1) * (result.degree_t + 1));
    for (int j = 0; j <= f.degree_t; ++j)
        for (int i = 0; i <= f.degree_s; ++i)
            for (int l = 0; l <= g.degree_t; ++l)
                for (int k = 0; k <= g.degree_s; ++k) {
                    const double share = binomial(f.degree_s, i) * binomial(g.degree_s, k) /
                                         binomial(result.degree_s, i + k) * binomial(f.degree_t, j) *
                                         binomial(g.degree_t, l) / binomial(result.degree_t, j + l);
                    result.at(i + k, j + l) += share * combine(f.at(i, j), g.at(k, l));
                }
    return result;
}

} // namespace

BezierPatch bezier_of(const NurbsSurface& surface, int span_u, int span_v)
{
    const int p = surface.degree_u, q = surface.degree_v;
    const Eigen::MatrixXd along_u = extraction(surface.knots_u, p, span_u),
                          along_v = extraction(surface.knots_v, q, span_v);
    BezierPatch result{p, q, Eigen::MatrixXd::Zero(4, (p + 1) * (q + 1))};
    for (int b = 0; b <= q; ++b)
        for (int a = 0; a <= p; ++a) {
            const int c = surface.index(span_u - p + a, span_v - q + b);
            Eigen::Vector4d point;
            point << surface.weight[c] * surface.control.col(c), surface.weight[c];
            for (int j = 0; j <= q; ++j)
                for (int i = 0; i <= p; ++i)
                    result.at(i, j) += along_u(i, a) * along_v(j, b) * point;
        }
    return result;
}

BezierPatch derivative_s(const BezierPatch& f)
{
    BezierPatch result{f.degree_s - 1, f.degree_t,
                       Eigen::MatrixXd(f.coefficient.rows(), f.degree_s * (f.degree_t + 1))};
    for (int j = 0; j <= f.degree_t; ++j)
        for (int i = 0; i < f.degree_s; ++i)
            result.at(i, j) = f.degree_s * (f.at(i + 1, j) - f.at(i, j));
    return result;
}

BezierPatch derivative_t(const BezierPatch& f)
{
    BezierPatch result{f.degree_s, f.degree_t - 1,
                       Eigen::MatrixXd(f.coefficient.rows(), (f.degree_s + 1) * f.degree_t)};
    for (int j = 0; j < f.degree_t; ++j)
        for (int i = 0; i <= f.degree_s; ++i)
            result.at(i, j) = f.degree_t * (f.at(i, j + 1) - f.at(i, j));
    return result;
}

BezierPatch sum(const BezierPatch& f, const BezierPatch& g)
{
    return {f.degree_s, f.degree_t, f.coefficient + g.coefficient};
}

BezierPatch cross(const BezierPatch& f, const BezierPatch& g)
{
    return product(f, g, 3, [](const auto& a, const auto& b) -> Eigen::Vector3d {
        return Eigen::Vector3d(a).cross(Eigen::Vector3d(b));
    });
}

BezierPatch times(const BezierPatch& factor, const BezierPatch& g)
{
    return product(factor, g, g.coefficient.rows(),
                   [](const auto& a, const auto& b) -> Eigen::VectorXd { return a[0] * b; });
}

BezierPatch rows(const BezierPatch& f, int first, int count)
{
    return {f.degree_s, f.degree_t, f.coefficient.middleRows(first, count)};
}

BezierPatch half_s(const BezierPatch& f, bool second)
{
    BezierPatch result = f;
    for (int j = 0; j <= f.degree_t; ++j)
        for (int r = 1; r <= f.degree_s; ++r)
            if (second)
                for (int i = 0; i <= f.degree_s - r; ++i)
                    result.at(i, j) = (result.at(i, j) + result.at(i + 1, j)) / 2;
            else
                for (int i = f.degree_s; i >= r; --i)
                    result.at(i, j) = (result.at(i, j) + result.at(i - 1, j)) / 2;
    return result;
}

BezierPatch half_t(const BezierPatch& f, bool second)
{
    BezierPatch result = f;
    for (int i = 0; i <= f.degree_s; ++i)
        for (int r = 1; r <= f.degree_t; ++r)
            if (second)
                for (int j = 0; j <= f.degree_t - r; ++j)
                    result.at(i, j) = (result.at(i, j) + result.at(i, j + 1)) / 2;
            else
                for (int j = f.degree_t; j >= r; --j)
                    result.at(i, j) = (result.at(i, j) + result.at(i, j - 1)) / 2;
    return result;
}

} // namespace spia
