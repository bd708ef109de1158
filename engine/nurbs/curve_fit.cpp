#include "engine/nurbs/curve_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/end_tangent.h"

namespace spia {

namespace {

/// P2 = P1 + rate (P1 - P0) makes the second derivative vanish at the first end.
double natural_rate(const std::vector<double>& knots, int degree)
{
    const size_t p = size_t(degree);
    return (knots[p + 2] - knots[2]) / (knots[p + 1] - knots[1]);
}

/// Half of the way to both neighbours.
std::vector<double> weights(const std::vector<double>& parameters)
{
    std::vector<double> weight(parameters.size(), 0);
    for (size_t i = 0; i + 1 < parameters.size(); ++i) {
        weight[i] += (parameters[i + 1] - parameters[i]) / 2;
        weight[i + 1] += (parameters[i + 1] - parameters[i]) / 2;
    }
    return weight;
}

} // namespace

std::vector<double> clamped_knots(const std::vector<double>& borders, int degree)
{
    std::vector<double> knots(size_t(degree), borders.front());
    knots.insert(knots.end(), borders.begin(), borders.end());
    knots.insert(knots.end(), size_t(degree), borders.back());
    return knots;
}

CurveFit::CurveFit(std::vector<double> knots, int degree, CurveEnds ends, const std::vector<double>& parameters)
    : degree_(degree), ends_(ends), knots_(std::move(knots)), parameters_(parameters), weight_(weights(parameters))
{
    const int n = count(), points = int(parameters_.size());
    const int held_each = ends_ == CurveEnds::averaged_knots ? 1 : 2;
    if (ends_ == CurveEnds::natural && degree_ < 3)
        throw InputError("natural ends need a second derivative that changes: choose degree 3 or more");
    if (n < std::max(degree_ + 1, ends_ == CurveEnds::natural ? 6 : 2 * held_each))
        throw InputError(
            fmt::format("{} control points are too few for {} ends of degree {}", n, name(ends_), degree_));

    held_.assign(size_t(n), 0);
    held_.front() = held_.back() = 1;
    if (ends_ == CurveEnds::natural) { // the third ones follow from the first two
        rate_start_ = natural_rate(knots_, degree_);
        rate_end_ = natural_rate(mirrored(knots_), degree_);
        held_[2] = held_[size_t(n) - 3] = 1;
    }
    if (ends_ == CurveEnds::clamped) {
        held_[1] = held_[size_t(n) - 2] = 1;
        const size_t p = size_t(degree_), m = knots_.size() - 1;
        const int stencil = std::min(degree_ + 1, points);
        tangent_start_ = (knots_[p + 1] - knots_[1]) / degree_ * end_derivative_weights(parameters_, stencil, true);
        tangent_end_ =
            (knots_[m - 1] - knots_[m - p - 1]) / degree_ * end_derivative_weights(parameters_, stencil, false);
    }

    band_ = degree_ + (ends_ == CurveEnds::natural ? 4 : 0);
    for (const double t : parameters_) {
        const BasisValues N = basis(knots_, degree_, t);
        Row row{N.first, Eigen::VectorXd(degree_ + 1), 0, {}};
        for (int k = 0; k <= degree_; ++k)
            row.plain[k] = N.value[size_t(k)];
        row.first_free = std::max(0, N.first - (band_ - degree_) / 2);
        row.free = Eigen::VectorXd::Zero(std::min(n - row.first_free, band_ + 1));
        row.free.segment(N.first - row.first_free, degree_ + 1) = row.plain;
        if (ends_ == CurveEnds::natural) {
            express_third(row, 0, 1, 2, rate_start_);
            express_third(row, n - 1, n - 2, n - 3, rate_end_);
        }
        row_.push_back(std::move(row));
    }
    factorize();
}

/// Gives the share of the third control point to the two that it follows from.
void CurveFit::express_third(Row& row, int first, int second, int third, double rate)
{
    const auto inside = [&](int c) { return c >= row.first_free && c < row.first_free + row.free.size(); };
    if (!inside(third) || row.free[third - row.first_free] == 0)
        return;
    assert(inside(first) && inside(second));
    const double share = row.free[third - row.first_free];
    row.free[third - row.first_free] = 0;
    row.free[second - row.first_free] += (1 + rate) * share;
    row.free[first - row.first_free] -= rate * share;
}

void CurveFit::factorize()
{
    const int n = count();
    // (i, j) in row i, column j - i + band_
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, band_ + 1);
    for (size_t r = 0; r < row_.size(); ++r) {
        const Row& row = row_[r];
        for (int a = 0; a < row.free.size(); ++a)
            for (int b = 0; b <= a; ++b)
                if (!held_[size_t(row.first_free + a)] && !held_[size_t(row.first_free + b)])
                    matrix(row.first_free + a, b - a + band_) += weight_[r] * row.free[a] * row.free[b];
    }
    factor_ = Eigen::MatrixXd::Zero(n, band_ + 1);
    for (int i = 0; i < n; ++i) {
        if (held_[size_t(i)]) {
            factor_(i, band_) = 1;
            continue;
        }
        for (int j = std::max(0, i - band_); j <= i; ++j) {
            double sum = matrix(i, j - i + band_);
            for (int k = std::max({0, i - band_, j - band_}); k < j; ++k)
                sum -= factor_(i, k - i + band_) * factor_(j, k - j + band_);
            if (j < i) {
                factor_(i, j - i + band_) = sum / factor_(j, band_);
                continue;
            }
            constexpr double least = 1e-12; // of what would be left were the points plentiful
            if (!(sum > least * matrix(i, band_)))
                throw InputError(
                    fmt::format("the data are too few for {} control points of degree {} (at knot {:.6g}): "
                                "give finer data or allow fewer knots",
                                n, degree_, knots_[size_t(i)]));
            factor_(i, band_) = std::sqrt(sum);
        }
    }
}

void CurveFit::set_held(Eigen::MatrixXd& control, const Eigen::Ref<const Eigen::MatrixXd>& points) const
{
    const Eigen::Index n = control.cols(), N = points.cols();
    control.col(0) = points.col(0);
    control.col(n - 1) = points.col(N - 1);
    if (ends_ != CurveEnds::clamped)
        return;
    control.col(1) = points.col(0);
    control.col(n - 2) = points.col(N - 1);
    for (Eigen::Index k = 0; k < tangent_start_.size(); ++k) {
        control.col(1) += tangent_start_[k] * points.col(k);
        control.col(n - 2) -= tangent_end_[k] * points.col(N - 1 - k);
    }
}

Eigen::Matrix3Xd CurveFit::control(const Eigen::Matrix3Xd& points, int width) const
{
    const int n = count();
    const Eigen::Map<const Eigen::MatrixXd> data(points.data(), 3 * width, Eigen::Index(parameters_.size()));
    Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, Eigen::Index(width) * n);
    Eigen::MatrixXd held = Eigen::MatrixXd::Zero(3 * width, n); // what is known beforehand
    set_held(held, data);
    Eigen::MatrixXd x = Eigen::MatrixXd::Zero(3 * width, n);
    for (size_t r = 0; r < row_.size(); ++r) {
        const Row& row = row_[r];
        Eigen::VectorXd rest = data.col(Eigen::Index(r));
        for (int k = 0; k < row.free.size(); ++k)
            if (held_[size_t(row.first_free + k)] && row.free[k] != 0)
                rest -= row.free[k] * held.col(row.first_free + k);
        for (int k = 0; k < row.free.size(); ++k)
            if (!held_[size_t(row.first_free + k)] && row.free[k] != 0)
                x.col(row.first_free + k) += weight_[r] * row.free[k] * rest;
    }
    for (int i = 0; i < n; ++i) {
        for (int k = std::max(0, i - band_); k < i; ++k)
            if (factor_(i, k - i + band_) != 0)
                x.col(i) -= factor_(i, k - i + band_) * x.col(k);
        x.col(i) /= factor_(i, band_);
    }
    for (int i = n - 1; i >= 0; --i) {
        for (int k = i + 1; k <= std::min(n - 1, i + band_); ++k)
            if (factor_(k, i - k + band_) != 0)
                x.col(i) -= factor_(k, i - k + band_) * x.col(k);
        x.col(i) /= factor_(i, band_);
    }
    x += held;
    if (ends_ == CurveEnds::natural) {
        x.col(2) = x.col(1) + rate_start_ * (x.col(1) - x.col(0));
        x.col(n - 3) = x.col(n - 2) + rate_end_ * (x.col(n - 2) - x.col(n - 1));
    }
    Eigen::Map<Eigen::MatrixXd>(result.data(), 3 * width, n) = x;
    return result;
}

Eigen::Matrix3Xd CurveFit::at_parameters(const Eigen::Matrix3Xd& control, int width) const
{
    const Eigen::Map<const Eigen::MatrixXd> net(control.data(), 3 * width, count());
    Eigen::Matrix3Xd result(3, Eigen::Index(width) * Eigen::Index(row_.size()));
    Eigen::Map<Eigen::MatrixXd> out(result.data(), 3 * width, Eigen::Index(row_.size()));
    for (size_t r = 0; r < row_.size(); ++r)
        out.col(Eigen::Index(r)) = net.middleCols(row_[r].first, degree_ + 1) * row_[r].plain;
    return result;
}

} // namespace spia
