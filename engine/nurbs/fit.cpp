#include "engine/nurbs/fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <optional>

#include "engine/core/error.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/coarsen.h"
#include "engine/nurbs/correct_parameters.h"
#include "engine/nurbs/evaluate.h"
#include "engine/nurbs/fit_attempt.h"
#include "engine/nurbs/fit_curve.h"
#include "engine/nurbs/fit_judge.h"
#include "engine/nurbs/fit_patch.h"
#include "engine/nurbs/fit_shortfall.h"
#include "engine/nurbs/foot_point_projection.h"
#include "engine/nurbs/interpolate.h"
#include "engine/nurbs/refinement_indicators.h"
#include "engine/nurbs/span_borders.h"

namespace spia {

namespace {

void require_in_range(const FitSource& source, const FitOptions& options)
{
    if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
        throw InputError(fmt::format("a tolerance of {} mm cannot be met; give a positive one", options.tolerance));
    for (const int degree : {options.degree_u, options.degree_v})
        if (degree < 2 || degree > 5)
            throw InputError(fmt::format("degree {} is not offered; choose one from 2 to 5", degree));
    for (const auto* lines : {&source.lines_u, &source.lines_v})
        if (!lines->empty() && lines->size() < 3)
            throw InputError("a fit needs at least 3 x 3 points; choose a finer grid");
    if (options.max_control_points < 16)
        throw InputError(
            fmt::format("{} control points are too few for a surface; allow 16 or more", options.max_control_points));
}

/// The most urgent spans of both directions, as many as the number of control points allows.
struct Halving {
    std::vector<char> u, v;
    int count = 0;
    bool out_of_data = false; ///< a span that wants to be halved cannot be
    bool out_of_points = false;
};

Halving choose(const RefinementIndicators& missing, const Attempt& fit, const FitSource& source,
               const FitOptions& options)
{
    struct Wish {
        double urgency;
        bool along_u;
        size_t span;
    };
    std::vector<Wish> wishes;
    Halving result{std::vector<char>(missing.u.size(), 0), std::vector<char>(missing.v.size(), 0), 0, false, false};
    const auto collect = [&](const std::vector<double>& urgency, const std::vector<double>& borders,
                             const std::vector<double>& lines, bool along_u) {
        for (size_t s = 0; s < urgency.size(); ++s)
            if (urgency[s] > 0) {
                if (may_halve(borders[s], borders[s + 1], lines))
                    wishes.push_back({urgency[s], along_u, s});
                else
                    result.out_of_data = true;
            }
    };
    collect(missing.u, fit.borders_u, source.lines_u, true);
    collect(missing.v, fit.borders_v, source.lines_v, false);
    std::stable_sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) { return a.urgency > b.urgency; });
    double count_u = fit.surface.count_u, count_v = fit.surface.count_v;
    for (const Wish& wish : wishes) {
        const double more_u = count_u + wish.along_u, more_v = count_v + !wish.along_u;
        if (more_u * more_v > options.max_control_points) {
            result.out_of_points = true;
            continue;
        }
        count_u = more_u;
        count_v = more_v;
        (wish.along_u ? result.u : result.v)[wish.span] = 1;
        ++result.count;
    }
    return result;
}

/// The spans that the two border curves along u (along v) need.
std::vector<double> borders_of_sides(const FitSource& source, const FitOptions& options, bool along_u)
{
    CurveFitOptions of_curve;
    of_curve.tolerance = options.tolerance;
    of_curve.degree = along_u ? options.degree_u : options.degree_v;
    of_curve.ends = options.ends;
    of_curve.lines = along_u ? source.lines_u : source.lines_v;
    of_curve.most_spans = int(std::sqrt(double(options.max_control_points))) / 2;
    std::vector<double> result = first_borders(options.ends);
    for (const double across : {0., 1.}) {
        const std::vector<double> ends = {0, 1}; // a source may ask for both borders of the other
                                                 // direction
        const CurveSource side = [&](const std::vector<double>& t) -> Eigen::Matrix3Xd {
            const Eigen::Index n = Eigen::Index(t.size());
            const Eigen::Matrix3Xd both = along_u ? source.at(t, ends) : source.at(ends, t);
            if (both.cols() != 2 * n)
                throw InputError("the source of the fit gives another number of points than it was asked for");
            return along_u ? Eigen::Matrix3Xd(both.middleCols(across > 0 ? n : 0, n))
                           : Eigen::Matrix3Xd(both(Eigen::all, Eigen::seqN(across > 0 ? 1 : 0, n, 2)));
        };
        result = united(result, fit_curve(side, of_curve).borders);
    }
    return result;
}

/// mm around the worst place within which its cause lies: what one cell of the knots and its
/// neighbours cover.
double reach_of(const NurbsSurface& surface, const BeyondTolerance& worst)
{
    const auto borders_u = span_borders(surface.knots_u, surface.degree_u);
    const auto borders_v = span_borders(surface.knots_v, surface.degree_v);
    const SurfacePoint at = evaluate(surface, worst.u, worst.v);
    const size_t a = size_t(span_of(borders_u, worst.u)), b = size_t(span_of(borders_v, worst.v));
    return worst.distance + 2 * std::max(at.S_u.norm() * (borders_u[a + 1] - borders_u[a]),
                                         at.S_v.norm() * (borders_v[b + 1] - borders_v[b]));
}

/// The surface through the nodes of a fixed grid: as close as its data allow.
std::optional<NurbsSurface> through_all(const FitSource& source, const FitOptions& options)
{
    if (source.lines_u.empty() || source.lines_v.empty() ||
        (options.ends == CurveEnds::natural && (options.degree_u != 3 || options.degree_v != 3)))
        return {};
    QuadGrid grid;
    grid.columns = int(source.lines_u.size()) - 1;
    grid.rows = int(source.lines_v.size()) - 1;
    grid.position = source.at(source.lines_u, source.lines_v);
    InterpolateOptions interpolation;
    interpolation.ends = options.ends;
    interpolation.parameters = InterpolateOptions::Parameters::uniform;
    interpolation.degree_u = options.degree_u;
    interpolation.degree_v = options.degree_v;
    NurbsSurface surface = interpolate(grid, interpolation).surface;
    if (surface.control.cols() > options.max_control_points)
        return {};
    return surface;
}

FitShortfall shortfall_of(const NurbsSurface& surface, const Judgement& judgement, const TriMesh& mesh,
                          const FitOptions& options, bool out_of_points)
{
    const Deviation& d = judgement.deviation;
    const auto& missing = judgement.missing;
    const auto worst = std::max_element(missing.begin(), missing.end(),
                                        [](const auto& a, const auto& b) { return a.distance < b.distance; });
    const Eigen::Vector3d where =
        d.surface_to_mesh.max >= d.mesh_to_surface.max ? d.surface_to_mesh.where : d.mesh_to_surface.where;
    return find_shortfall(surface, mesh, options, where, reach_of(surface, *worst), std::max(d.max(), worst->distance),
                          out_of_points ? FitShortfall::Reason::control_points : FitShortfall::Reason::data);
}

} // namespace

FitSource source_of(const QuadGrid& lifted)
{
    if (lifted.columns < 1 || lifted.rows < 1 || lifted.position.cols() != lifted.nodes())
        throw InputError("the grid is empty, or its size and nodes disagree; fill and lift it again");
    FitSource source;
    const auto even = [](int cells) {
        std::vector<double> lines;
        for (int i = 0; i <= cells; ++i)
            lines.push_back(double(i) / cells);
        return lines;
    };
    source.lines_u = even(lifted.columns);
    source.lines_v = even(lifted.rows);
    source.at = [lifted](const std::vector<double>& u, const std::vector<double>& v) {
        Eigen::Matrix3Xd points(3, Eigen::Index(u.size() * v.size()));
        for (size_t j = 0; j < v.size(); ++j)
            for (size_t i = 0; i < u.size(); ++i)
                points.col(Eigen::Index(i + j * u.size())) = lifted.position.col(
                    lifted.node(int(std::lround(u[i] * lifted.columns)), int(std::lround(v[j] * lifted.rows))));
        return points;
    };
    return source;
}

FitResult fit(const FitSource& source, const TriMesh& mesh, const FitOptions& options, const Progress& progress)
{
    require_in_range(source, options);
    const FitJudge judge(mesh, options, progress.part(0, 0));
    progress.checkpoint(0, "fitting the border");
    // Points that slide need fewer knots than the border has where they stay.
    const bool corrected = options.parameters == FitParameters::corrected;
    std::vector<double> borders_u = corrected ? first_borders(options.ends) : borders_of_sides(source, options, true);
    std::vector<double> borders_v = corrected ? first_borders(options.ends) : borders_of_sides(source, options, false);

    std::optional<FootPointProjection> projection;
    if (corrected)
        projection.emplace(mesh);
    const auto fitted = [&](const SpanBorders& borders, const Progress& part) {
        Attempt result = attempt(source, options, borders.u, borders.v, part);
        if (projection)
            correct_parameters(result, *projection, part);
        return result;
    };

    struct Best {
        NurbsSurface surface;
        std::vector<double> u, v;
        Judgement judgement;
    };
    std::optional<Best> best;
    const auto better = [&](const Judgement& now) {
        if (!best || now.within != best->judgement.within)
            return !best || now.within;
        // More knots than the tolerance needs are worth it only where they take every fold away.
        return now.within ? now.deviation.turned.empty() && !best->judgement.deviation.turned.empty()
                          : now.deviation.max() < best->judgement.deviation.max();
    };
    FitResult result;
    result.report.tolerance = options.tolerance;
    bool out_of_points = false;
    constexpr int most_rounds_for_folds = 3; // once it is near enough
    for (int round = 1, folded_rounds = 0;; ++round) {
        const Progress here = progress.part(1 - std::pow(0.85, round - 1), 1 - std::pow(0.85, round));
        here.checkpoint(0, fmt::format("fitting {} x {} spans", borders_u.size() - 1, borders_v.size() - 1));
        Attempt now = fitted({borders_u, borders_v}, here.part(0, 0.2));
        Judgement judgement = judge.judge(now.surface, false, here.part(0.2, 1));
        result.report.rounds = round;
        Halving halve;
        if (!judgement.missing.empty() && !(judgement.within && ++folded_rounds > most_rounds_for_folds))
            halve = choose(refinement_indicators(now.surface, judgement.missing, now.points, now.along_u, now.along_v),
                           now, source, options);
        out_of_points = halve.out_of_points;
        if (better(judgement))
            best =
                Best{std::move(now.surface), now.along_u.parameters(), now.along_v.parameters(), std::move(judgement)};
        if (halve.count == 0)
            break;
        borders_u = halved(borders_u, halve.u);
        borders_v = halved(borders_v, halve.v);
    }
    // Of those that are proposed until there are none.
    const auto take_fewer = [&](auto&& proposals, const char* what) {
        while (best->judgement.within) {
            const std::optional<SpanBorders> fewer = proposals.next(best->surface, progress.part(0.9, 0.9));
            if (!fewer)
                break;
            progress.checkpoint(0.9, fmt::format("{} {} x {} spans", what, fewer->u.size() - 1, fewer->v.size() - 1));
            Attempt now = fitted(*fewer, progress.part(0.9, 0.9));
            Judgement judgement = judge.judge(now.surface, false, progress.part(0.9, 0.95));
            const bool good =
                judgement.within && judgement.deviation.turned.size() <= best->judgement.deviation.turned.size();
            proposals.tried(good);
            if (good)
                best = Best{std::move(now.surface), now.along_u.parameters(), now.along_v.parameters(),
                            std::move(judgement)};
        }
    };
    // Halving gives more than is needed: where two halves are far better than asked for, they are
    // joined again. Spans of even change can be fewer than halved ones.
    take_fewer(SpanMerging(mesh, options), "joining to");
    take_fewer(KnotEquidistribution(source, options), "evening");
    if (corrected)
        take_fewer(KnotRemoval(options), "sparing to");
    if (!best->judgement.within) {
        best->judgement = judge.judge(best->surface, true, progress.part(0.9, 0.95));
        if (std::optional<NurbsSurface> through = through_all(source, options)) {
            Judgement judgement = judge.judge(*through, true, progress.part(0.95, 1));
            if (better(judgement))
                best = Best{std::move(*through), source.lines_u, source.lines_v, std::move(judgement)};
        }
    }
    result.report.reached = best->judgement.within;
    if (!result.report.reached)
        result.report.shortfall = shortfall_of(best->surface, best->judgement, mesh, options, out_of_points);
    result.surface = std::move(best->surface);
    result.u = std::move(best->u);
    result.v = std::move(best->v);
    result.deviation = std::move(best->judgement.deviation);
    result.report.knots_u = result.surface.count_u - result.surface.degree_u - 1;
    result.report.knots_v = result.surface.count_v - result.surface.degree_v - 1;
    return result;
}

} // namespace spia
