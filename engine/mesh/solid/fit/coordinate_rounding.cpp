#include "engine/mesh/solid/fit/coordinate_rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spia {
namespace {

/// Between numbers of single precision of that size.
double single_spacing(double size)
{
    const float at = float(size);
    return double(std::nextafter(at, std::numeric_limits<float>::infinity())) - at;
}

/// Whether it is a multiple but for the digits of the precision in which it is kept.
bool is_multiple(double x, double step, double precision)
{
    return std::abs(x - step * std::round(x / step)) <= precision * std::abs(x);
}

/// The greatest power of ten, 1 at most, of which all coordinates are multiples; 0 if that is none
/// of ten steps of the precision and more: among fewer chance finds some.
double decimal_step(const Eigen::MatrixXd& x, double precision)
{
    const double least = 10 * precision * x.cwiseAbs().maxCoeff();
    for (int decimals = 0; std::pow(10., -decimals) > least; ++decimals) {
        const double step = std::pow(10., -decimals);
        if (std::ranges::all_of(x.reshaped(), [&](double c) { return is_multiple(c, step, precision); }))
            return step;
    }
    return 0;
}

/// That of the last of the significant digits with which all coordinates can be written, of the
/// largest; 0 if these are more than the six that single precision always has.
double last_digit(const Eigen::MatrixXd& x, double precision)
{
    const auto step = [](double c, int digits) { return std::pow(10., std::floor(std::log10(c)) + 1 - digits); };
    constexpr int most = 6;
    for (int digits = 1; digits <= most; ++digits)
        if (std::ranges::all_of(
                x.reshaped(), [&](double c) { return c == 0 || is_multiple(c, step(std::abs(c), digits), precision); }))
            return step(x.cwiseAbs().maxCoeff(), digits);
    return 0;
}

} // namespace

double coordinate_rounding(const Eigen::Matrix3Xd& position, double unit)
{
    if (position.cols() == 0 || !(position.cwiseAbs().maxCoeff() > 0))
        return 0;
    const Eigen::Matrix3Xd x = position / unit;
    // Half the last bit of single precision; of double that of the file and those of its unit.
    constexpr double single = std::numeric_limits<float>::epsilon() / 2,
                     twofold = 4 * std::numeric_limits<double>::epsilon();
    const double written = decimal_step(x, twofold);
    const double decimal = std::max({written, decimal_step(x, single), last_digit(x, single)});
    Eigen::Vector3d step;
    for (int axis = 0; axis < 3; ++axis) {
        // Single precision far from the origin may have been written with more decimals than it
        // has.
        const bool was_single = std::ranges::all_of(x.row(axis).reshaped(), [&](double c) {
            return std::abs(c - double(float(c))) <= written / 2 + twofold * std::abs(c);
        });
        step[axis] = std::max(decimal, was_single ? single_spacing(x.row(axis).cwiseAbs().maxCoeff()) : 0.);
    }
    return unit * step.norm() / 2;
}

} // namespace spia
