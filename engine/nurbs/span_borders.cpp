#include "engine/nurbs/span_borders.h"

#include <algorithm>
#include <iterator>

namespace spia {

std::vector<double> first_borders(CurveEnds ends)
{
    switch (ends) {
    case CurveEnds::averaged_knots: break;
    case CurveEnds::clamped: return {0, 0.5, 1};
    case CurveEnds::natural: return {0, 0.25, 0.5, 0.75, 1};
    }
    return {0, 1};
}

bool may_halve(double from, double to, const std::vector<double>& lines)
{
    constexpr double narrowest = 1. / (1 << 20);
    if (lines.empty())
        return to - from > 1.5 * narrowest;
    // With two lines in every span no set of functions has fewer data than members (Schoenberg and
    // Whitney), and some are left to say how far the curve is from them.
    const double middle = (from + to) / 2;
    const auto below = [&](double t) { return std::lower_bound(lines.begin(), lines.end(), t) - lines.begin(); };
    return below(middle) - below(from) >= 2 && below(to) - below(middle) >= 2;
}

std::vector<double> halved(const std::vector<double>& borders, const std::vector<char>& halve)
{
    std::vector<double> result;
    for (size_t s = 0; s + 1 < borders.size(); ++s) {
        result.push_back(borders[s]);
        if (halve[s])
            result.push_back((borders[s] + borders[s + 1]) / 2);
    }
    result.push_back(borders.back());
    return result;
}

std::vector<double> united(const std::vector<double>& a, const std::vector<double>& b)
{
    std::vector<double> result;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
}

std::vector<double> data_parameters(const std::vector<double>& borders, const std::vector<double>& lines)
{
    if (!lines.empty())
        return lines;
    const int each = borders.size() > 4 ? 4 : 8; // more than degree + 1 for a single span
    std::vector<double> result;
    for (size_t s = 0; s + 1 < borders.size(); ++s)
        for (int k = 0; k < each; ++k)
            result.push_back(borders[s] + (borders[s + 1] - borders[s]) * k / each);
    result.push_back(borders.back());
    return result;
}

int span_of(const std::vector<double>& borders, double t)
{
    const auto after = std::upper_bound(borders.begin() + 1, borders.end() - 1, t);
    return int(after - borders.begin()) - 1;
}

} // namespace spia
