#include "engine/nurbs/coarsen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/nurbs/basis.h"
#include "engine/nurbs/equidistributed_spans.h"
#include "engine/nurbs/span_borders.h"

namespace spia {

namespace {

constexpr Eigen::Index most_control_points = 20'000; // beyond, a trial takes seconds
constexpr size_t most_trials = 16;
constexpr double greatest_factor = 64; // more than a cubic loses by joining two spans

/// Joins halves of one span in which nothing is farther away than `distance`. @param largest per
/// span, mm
std::vector<double> joined(const std::vector<double>& borders, const std::vector<double>& largest, double distance,
                           size_t fewest)
{
    std::vector<double> result = {borders.front()};
    size_t left = borders.size() - 1;
    for (size_t s = 0; s + 1 < borders.size(); ++s) {
        if (s + 2 < borders.size() && left > fewest) {
            const double width = borders[s + 1] - borders[s];
            const bool halves =
                // of one dyadic span
                borders[s + 2] - borders[s + 1] == width && std::fmod(borders[s], 2 * width) == 0;
            if (halves && std::max(largest[s], largest[s + 1]) <= distance) {
                result.push_back(borders[s + 2]);
                ++s;
                --left;
                continue;
            }
        }
        result.push_back(borders[s + 1]);
    }
    return result;
}

} // namespace

std::optional<SpanBorders> SpanMerging::next(const NurbsSurface& surface, const Progress& progress)
{
    if (surface.control.cols() > most_control_points)
        return {};
    const SpanBorders now{span_borders(surface.knots_u, surface.degree_u),
                          span_borders(surface.knots_v, surface.degree_v)};
    DeviationOptions all;
    all.part_faces = options_.part_faces;
    all.tolerance = options_.tolerance;
    all.listed_from = 0;
    all.mesh_to_surface = false;
    std::vector<double> of_u(now.u.size() - 1, 0), of_v(now.v.size() - 1, 0);
    for (const BeyondTolerance& sample : deviation(surface, mesh_, all, progress).beyond) {
        double& at_u = of_u[size_t(span_of(now.u, sample.u))];
        double& at_v = of_v[size_t(span_of(now.v, sample.v))];
        at_u = std::max(at_u, sample.distance);
        at_v = std::max(at_v, sample.distance);
    }
    const size_t fewest = first_borders(options_.ends).size() - 1;
    for (; factor_ <= greatest_factor && tried_.size() < most_trials;
         along_u_ = !along_u_, factor_ *= along_u_ ? 2 : 1) {
        const double distance = options_.tolerance / factor_;
        SpanBorders proposed = now;
        (along_u_ ? proposed.u : proposed.v) =
            along_u_ ? joined(now.u, of_u, distance, fewest) : joined(now.v, of_v, distance, fewest);
        if (proposed.u.size() + proposed.v.size() < now.u.size() + now.v.size() &&
            std::find(tried_.begin(), tried_.end(), proposed) == tried_.end()) {
            tried_.push_back(proposed);
            return proposed;
        }
    }
    return {};
}

void SpanMerging::tried(bool good)
{
    if (good)
        return;
    along_u_ = !along_u_;
    factor_ *= along_u_ ? 2 : 1;
}

std::optional<SpanBorders> KnotRemoval::next(const NurbsSurface& surface, const Progress&)
{
    constexpr Eigen::Index most_controls = 1'000;
    constexpr size_t most_tries = 12, most_tries_at_once = 4;
    if (options_.ends != CurveEnds::averaged_knots || surface.control.cols() > most_controls)
        return {};
    const SpanBorders now{span_borders(surface.knots_u, surface.degree_u),
                          span_borders(surface.knots_v, surface.degree_v)};
    if (surface.control.cols() != controls_) {
        controls_ = surface.control.cols();
        at_once_ = 0;
    }
    std::optional<SpanBorders> best;
    double least = std::numeric_limits<double>::infinity();
    for (const bool along_u : {true, false}) {
        const std::vector<double> significance = knot_significance(surface, along_u);
        const double saved = along_u ? surface.count_v : surface.count_u;
        for (size_t k = 0; k < significance.size(); ++k) {
            if (significance[k] / saved >= least)
                continue;
            SpanBorders proposed = now;
            std::vector<double>& borders = along_u ? proposed.u : proposed.v;
            borders.erase(borders.begin() + std::ptrdiff_t(k) + 1);
            if (std::find(tried_.begin(), tried_.end(), proposed) != tried_.end())
                continue;
            least = significance[k] / saved;
            best = std::move(proposed);
        }
    }
    if (!best || tried_.size() == most_tries || ++at_once_ > most_tries_at_once)
        return {};
    tried_.push_back(*best);
    return best;
}

std::optional<SpanBorders> KnotEquidistribution::next(const NurbsSurface& surface, const Progress&)
{
    constexpr Eigen::Index most_controls = 4'000;
    constexpr int most_tries = 14;
    // others ask for certain spans at the ends
    const bool single = options_.ends == CurveEnds::averaged_knots;
    if (!single || !source_.lines_u.empty() || !source_.lines_v.empty() || surface.control.cols() > most_controls)
        return {};
    const SpanBorders now{span_borders(surface.knots_u, surface.degree_u),
                          span_borders(surface.knots_v, surface.degree_v)};
    for (int direction = 0; direction < 2 && trials_ < most_tries; ++direction, along_u_ = !along_u_) {
        const int spans = int((along_u_ ? now.u : now.v).size()) - 1;
        double& share = share_[along_u_ ? 0 : 1];
        const int fewer = std::max(1, int(share * spans));
        if (share <= 0 || spans < 2)
            continue;
        ++trials_;
        SpanBorders proposed = now;
        (along_u_ ? proposed.u : proposed.v) = equidistributed_spans(surface, along_u_, spans - fewer);
        if (fewer == 1)
            share = -std::abs(share); // the least that can be tried
        return proposed;
    }
    return {};
}

void KnotEquidistribution::tried(bool good)
{
    double& share = share_[along_u_ ? 0 : 1];
    if (good)
        share = std::abs(share);
    else if (share > 0)
        share /= 2;
    along_u_ = !along_u_;
}

} // namespace spia
