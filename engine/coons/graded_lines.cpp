#include "engine/coons/graded_lines.h"

#include <algorithm>
#include <cmath>

namespace spia {
namespace {

/// How far lines are apart, where they are, times their number. Over samples of equal length.
Eigen::ArrayXd wanted_spacing(const Eigen::VectorXd& weight, double share, int samples_each)
{
    const double mean = weight.mean();
    Eigen::ArrayXd spacing(weight.size() * samples_each);
    for (Eigen::Index k = 0; k < spacing.size(); ++k)
        spacing[k] = 1 / (1 - share + share * weight[k / samples_each] / mean);
    return spacing;
}

/// The largest spacing below this one whose slope nowhere exceeds the given one.
Eigen::ArrayXd with_slope(Eigen::ArrayXd spacing, double slope)
{
    const double step = slope / double(spacing.size());
    for (Eigen::Index k = 1; k < spacing.size(); ++k)
        spacing[k] = std::min(spacing[k], spacing[k - 1] + step);
    for (Eigen::Index k = spacing.size() - 2; k >= 0; --k)
        spacing[k] = std::min(spacing[k], spacing[k + 1] + step);
    return spacing;
}

} // namespace

Eigen::VectorXd graded_lines(const Eigen::VectorXd& weight, int intervals, double share, double growth)
{
    Eigen::VectorXd lines = Eigen::VectorXd::LinSpaced(intervals + 1, 0, intervals) / intervals;
    if (!(weight.sum() > 0) || !(share > 0) || intervals < 2)
        return lines;
    constexpr double fine = 256; // samples where lines lie evenly
    const int samples_each = std::max(1, int(std::ceil(fine * intervals / double(weight.size()))));
    share = std::min(share, 1 - 1e-6); // no place without lines
    const Eigen::ArrayXd wanted = wanted_spacing(weight, share, samples_each);
    // Neighbours differ by the slope of the spacing over it. Where that is too steep lines are
    // added, and all are moved apart for it.
    const double slope = std::log(growth) * intervals;
    const auto spacing = [&](double scale) { return with_slope(scale * wanted, slope); };
    double low = 1, high = 1;
    while (spacing(high).inverse().mean() > 1)
        high *= 2;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = (low + high) / 2;
        (spacing(middle).inverse().mean() > 1 ? low : high) = middle;
    }
    const Eigen::ArrayXd density = spacing(high).inverse();
    const double all = density.sum();
    double sum = 0;
    int line = 1;
    for (Eigen::Index k = 0; k < density.size() && line < intervals; ++k) {
        const double here = density[k] / all;
        for (; line < intervals && sum + here >= double(line) / intervals; ++line)
            lines[line] = (double(k) + (double(line) / intervals - sum) / here) / double(density.size());
        sum += here;
    }
    return lines;
}

} // namespace spia
