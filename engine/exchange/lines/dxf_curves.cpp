#include "engine/exchange/lines/dxf_curves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace spia::dxf {
namespace {

constexpr double within = 2e-5; // of the radius, or of a curve's extent
constexpr int most_degree = 25;

int chords_of_turn(double turn) { return std::max(int(std::ceil(std::abs(turn) / (2 * std::acos(1 - within)))), 1); }

bool makes_sense(const Spline& spline)
{
    const size_t poles = spline.poles.size();
    if (spline.degree < 1 || spline.degree > most_degree || poles < size_t(spline.degree) + 1 ||
        spline.knots.size() != poles + size_t(spline.degree) + 1 ||
        (!spline.weights.empty() && spline.weights.size() != poles))
        return false;
    const auto domain_begin = spline.knots[size_t(spline.degree)], domain_end = spline.knots[poles];
    return std::is_sorted(spline.knots.begin(), spline.knots.end()) && domain_begin < domain_end &&
           std::all_of(spline.weights.begin(), spline.weights.end(), [](double w) { return w > 0; });
}

/// The place at a parameter of the span [knots[span], knots[span + 1]]. Knots need not be clamped.
Eigen::Vector3d place(const Spline& spline, size_t span, double u)
{
    const auto p = size_t(spline.degree);
    std::array<Eigen::Vector4d, most_degree + 1> d;
    for (size_t j = 0; j <= p; ++j) {
        const size_t i = span - p + j;
        const double weight = spline.weights.empty() ? 1 : spline.weights[i];
        d[j] << weight * spline.poles[i], weight;
    }
    for (size_t r = 1; r <= p; ++r)
        for (size_t j = p; j >= r; --j) {
            const double low = spline.knots[span - p + j], high = spline.knots[span + j + 1 - r];
            const double share = (u - low) / (high - low);
            d[j] = (1 - share) * d[j - 1] + share * d[j];
        }
    return d[p].head<3>() / d[p][3];
}

/// Halves a piece of a span until its middle, and those of its halves, lie on the chord.
void add_span(const Spline& spline, size_t span, double from, double to, const Eigen::Vector3d& a,
              const Eigen::Vector3d& b, double tolerance, int depth, Points& points)
{
    constexpr int least = 2, most = 14; // halvings: the first ones in any case, for a span may wind
                                        // about its chord
    const double middle = (from + to) / 2;
    const Eigen::Vector3d m = place(spline, span, middle), along = b - a;
    const double length = along.norm();
    const double off = length > 0 ? along.cross(m - a).norm() / length : (m - a).norm();
    if (depth >= most || (depth >= least && off <= tolerance)) {
        points.push_back(a);
        return;
    }
    add_span(spline, span, from, middle, a, m, tolerance, depth + 1, points);
    add_span(spline, span, middle, to, m, b, tolerance, depth + 1, points);
}

} // namespace

void add_arc(const Eigen::Vector3d& centre, double radius, double from, double turn, Points& points)
{
    const int chords = chords_of_turn(turn);
    for (int k = 0; k < chords; ++k) {
        const double a = from + turn * k / chords;
        points.emplace_back(centre + radius * Eigen::Vector3d(std::cos(a), std::sin(a), 0));
    }
}

void add_way(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double bulge, Points& points)
{
    if (bulge == 0 || (b - a).norm() == 0) {
        points.push_back(a);
        return;
    }
    const double turn = 4 * std::atan(bulge), radius = (b - a).norm() / (2 * std::abs(std::sin(turn / 2)));
    const Eigen::Vector3d along = (b - a).normalized(), left(-along[1], along[0], 0),
                          centre = (a + b) / 2 + left * ((b - a).norm() / 2 / std::tan(turn / 2));
    const size_t first = points.size();
    add_arc(centre, radius, std::atan2(a[1] - centre[1], a[0] - centre[0]), turn, points);
    points[first] = a; // to the last digit
}

Points ellipse(const Eigen::Vector3d& centre, const Eigen::Vector3d& major, double ratio, double from, double to)
{
    const Eigen::Vector3d minor = ratio * Eigen::Vector3d::UnitZ().cross(major);
    const int chords = chords_of_turn(to - from);
    Points points;
    for (int k = 0; k <= chords; ++k) {
        const double t = from + (to - from) * k / chords;
        points.emplace_back(centre + std::cos(t) * major + std::sin(t) * minor);
    }
    return points;
}

std::optional<Points> chords_of(const Spline& spline)
{
    if (!makes_sense(spline))
        return std::nullopt;
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& pole : spline.poles)
        box.extend(pole);
    const double tolerance = within * box.diagonal().norm();
    Points points;
    Eigen::Vector3d end = spline.poles.back();
    for (size_t span = size_t(spline.degree); span < spline.poles.size(); ++span) {
        const double from = spline.knots[span], to = spline.knots[span + 1];
        if (from == to)
            continue;
        const Eigen::Vector3d begin = place(spline, span, from);
        end = place(spline, span, to);
        add_span(spline, span, from, to, begin, end, tolerance, 0, points);
    }
    points.push_back(end);
    return points;
}

} // namespace spia::dxf
