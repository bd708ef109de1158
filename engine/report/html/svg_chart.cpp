#include "engine/report/html/svg_chart.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "engine/exchange/text/text_encoding.h"

namespace spia {
namespace {

constexpr double width = 360, height = 210, left = 44, right = 10, top = 26, bottom = 34;

/// From values to the picture along one axis.
struct Axis {
    double least, greatest; ///< of the values; exponents of ten if logarithmic
    double from, to;        ///< in the picture
    std::vector<double> ticks;

    double operator()(double value) const { return from + (value - least) / (greatest - least) * (to - from); }
};

/// 1, 2 or 5 times a power of ten, so that about `count` steps fit.
double step_for(double range, int count)
{
    const double raw = range / count, power = std::pow(10, std::floor(std::log10(raw)));
    for (const double factor : {1., 2., 5.})
        if (raw <= factor * power * (1 + 1e-9))
            return factor * power;
    return 10 * power;
}

Axis axis(double least, double greatest, double from, double to, int count)
{
    if (!(greatest > least)) {
        least -= 0.5;
        greatest = least + 1;
    }
    const double step = step_for(greatest - least, count);
    Axis result{least, greatest, from, to, {}};
    for (double k = std::ceil(least / step - 1e-9); k * step <= greatest + 1e-9 * step; ++k)
        result.ticks.push_back(k * step);
    return result;
}

/// Ends at whole powers of ten that bear a tick; the values are exponents.
Axis decades(double least, double greatest, double from, double to)
{
    const double step = std::max(1., std::ceil((std::ceil(greatest) - std::floor(least)) / 6));
    const double low = step * std::floor(least / step);
    const double high = std::max(step * std::ceil(greatest / step), low + step);
    Axis result{low, high, from, to, {}};
    for (double k = low; k <= high; k += step)
        result.ticks.push_back(k);
    return result;
}

/// The points that can be drawn; heights are exponents of ten on a logarithmic axis.
std::vector<Eigen::Vector2d> drawable(const Chart& chart, const ChartCurve& curve)
{
    std::vector<Eigen::Vector2d> points;
    for (const Eigen::Vector2d& p : curve.points)
        if (p.allFinite() && (!chart.logarithmic || p[1] > 0))
            points.push_back(chart.logarithmic ? Eigen::Vector2d(p[0], std::log10(p[1])) : p);
    return points;
}

std::string number(double value) { return fmt::format("{:.6g}", std::abs(value) < 1e-12 ? 0 : value); }

std::string tick_label(const Chart& chart, double value)
{
    if (!chart.logarithmic)
        return number(value);
    return fmt::format("10<tspan dy=\"-4\" font-size=\"7\">{}{}</tspan>", value < 0 ? "\u2212" : "",
                       number(std::abs(value)));
}

std::string grid(const Chart& chart, const Axis& x, const Axis& y)
{
    std::string text;
    for (const double value : y.ticks)
        text += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#e3e6ea\"/>"
                            "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n",
                            left, width - right, y(value), y(value), left - 6, y(value) + 3, tick_label(chart, value));
    for (const double value : x.ticks)
        text += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"#8a93a0\"/>"
                            "<text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\">{4}</text>\n",
                            x(value), height - bottom, height - bottom + 3, height - bottom + 13, number(value));
    text += fmt::format("<line x1=\"{}\" x2=\"{}\" y1=\"{}\" y2=\"{}\" stroke=\"#8a93a0\"/>\n", left, width - right,
                        height - bottom, height - bottom);
    text += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"#59636f\">{}</text>\n", width - right,
                        height - 6, escaped(chart.x_label));
    return text + fmt::format("<text x=\"{}\" y=\"12\" fill=\"#59636f\">{}</text>\n", 4, escaped(chart.y_label));
}

std::string line(const std::vector<Eigen::Vector2d>& points, const ChartCurve& curve, const Axis& x, const Axis& y)
{
    std::string list, dots;
    for (const Eigen::Vector2d& p : points) {
        if (curve.joined)
            list += fmt::format("{:.2f},{:.2f} ", x(p[0]), y(p[1]));
        if (curve.dots)
            dots += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"{}\"/>", x(p[0]), y(p[1]),
                                curve.joined ? "2" : "1.1", curve.colour);
    }
    if (!curve.joined)
        return dots + "\n";
    return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" "
                       "stroke-linejoin=\"round\"{}/>{}\n",
                       list, curve.colour, curve.dashed ? " stroke-dasharray=\"4 3\"" : "", dots);
}

std::string mark_line(const ChartMark& mark, const Axis& x)
{
    return fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#b45309\" "
                       "stroke-dasharray=\"3 3\"/>\n",
                       x(mark.x), top, height - bottom);
}

/// The words of a mark, on the side of its line with more room, one above the other; white around
/// them hides what they cross.
std::string mark_words(const ChartMark& mark, const Axis& x, size_t number)
{
    const bool turned = x(mark.x) > 0.6 * width;
    return fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"{}\" fill=\"#b45309\" stroke=\"#fff\" "
                       "stroke-width=\"3\" paint-order=\"stroke\">{}</text>\n",
                       x(mark.x) + (turned ? -4 : 4), height - bottom - 8 - 13 * double(number),
                       turned ? "end" : "start", escaped(mark.label));
}

/// The names of the curves in the right upper corner.
std::string key(const std::vector<ChartCurve>& curves)
{
    std::string names;
    for (const ChartCurve& curve : curves)
        if (!curve.label.empty() && !curve.points.empty())
            names += fmt::format("<tspan fill=\"{}\" font-weight=\"700\" dx=\"9\">\u2014</tspan> {}", curve.colour,
                                 escaped(curve.label));
    return fmt::format("<text x=\"{}\" y=\"12\" text-anchor=\"end\">{}</text>\n", width - right, names);
}

} // namespace

std::string svg(const Chart& chart)
{
    constexpr double none = std::numeric_limits<double>::infinity();
    Eigen::Vector2d low(none, none), high(-none, -none);
    std::vector<std::vector<Eigen::Vector2d>> curves;
    for (const ChartCurve& curve : chart.curves) {
        curves.push_back(drawable(chart, curve));
        for (const Eigen::Vector2d& p : curves.back()) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
    }
    if (!low.allFinite())
        return "";
    for (const ChartMark& each : chart.marks) {
        low[0] = std::min(low[0], each.x);
        high[0] = std::max(high[0], each.x);
    }
    if (chart.from_zero) {
        low[1] = std::min(low[1], 0.);
        high[1] *= 1.05; // room for the line
    }
    const Axis x = axis(low[0], high[0], left, width - right, 7);
    const Axis y = chart.logarithmic ? decades(low[1], high[1], height - bottom, top)
                                     : axis(low[1], high[1], height - bottom, top, 5);
    std::string text = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" font-size=\"9\" "
                                   "fill=\"#1f2933\">\n",
                                   width, height, escaped(chart.y_label + " over " + chart.x_label));
    text += grid(chart, x, y);
    for (const ChartMark& each : chart.marks)
        text += mark_line(each, x);
    for (size_t i = 0; i < curves.size(); ++i)
        text += line(curves[i], chart.curves[i], x, y);
    for (size_t i = 0; i < chart.marks.size(); ++i)
        text += mark_words(chart.marks[i], x, i);
    return text + key(chart.curves) + "</svg>\n";
}

} // namespace spia
