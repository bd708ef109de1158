#include "engine/nurbs/fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/text.h"
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

/// The best surface so far, and the ways to a better one.
class FitSearch {
public:
    FitSearch(const FitSource& source, const TriMesh& mesh, const FitOptions& options, const Progress& progress)
        : source_(source), mesh_(mesh), options_(options), progress_(progress),
          judge_(mesh, options, progress.part(0, 0))
    {
        if (corrected())
            projection_.emplace(mesh);
        report_.tolerance = options.tolerance;
    }

    bool corrected() const { return options_.parameters == FitParameters::corrected; }
    bool within() const { return best_->judgement.within; }

    /// Spans halved where the surface is too far from the part, and a few times more where it
    /// folds.
    bool halve_spans(AttemptReport& own)
    {
        constexpr int most_rounds_for_folds = 3; // once it is near enough
        progress_.checkpoint(0, "fitting the border");
        SpanBorders borders = first_spans();
        for (int round = 1, folded_rounds = 0;; ++round) {
            const Progress here = progress_.part(1 - std::pow(0.85, round - 1), 1 - std::pow(0.85, round));
            here.checkpoint(0, fmt::format("fitting {} x {} spans", borders.u.size() - 1, borders.v.size() - 1));
            Attempt now = fitted(borders, here.part(0, 0.2));
            Judgement judgement = judge_.judge(now.surface, false, here.part(0.2, 1));
            report_.rounds = round;
            Halving halve;
            if (!judgement.missing.empty() && !(judgement.within && ++folded_rounds > most_rounds_for_folds))
                halve =
                    choose(refinement_indicators(now.surface, judgement.missing, now.points, now.along_u, now.along_v),
                           now, source_, options_);
            out_of_points_ = halve.out_of_points;
            if (better(judgement))
                take(now, std::move(judgement));
            if (halve.count == 0)
                break;
            borders = {halved(borders.u, halve.u), halved(borders.v, halve.v)};
        }
        own.reason = outcome();
        return true;
    }

    /// Fewer spans of those that are proposed, until there are none.
    template <class Proposals> bool take_fewer(Proposals proposals, const char* what, AttemptReport& own)
    {
        int tried = 0, taken = 0;
        while (const std::optional<SpanBorders> fewer = proposals.next(best_->surface, progress_.part(0.9, 0.9))) {
            progress_.checkpoint(0.9, fmt::format("{} {} x {} spans", what, fewer->u.size() - 1, fewer->v.size() - 1));
            Attempt now = fitted(*fewer, progress_.part(0.9, 0.9));
            Judgement judgement = judge_.judge(now.surface, false, progress_.part(0.9, 0.95));
            const bool good =
                judgement.within && judgement.deviation.turned.size() <= best_->judgement.deviation.turned.size();
            proposals.tried(good);
            ++tried;
            taken += good;
            if (good)
                take(now, std::move(judgement));
        }
        own.reason = taken > 0 ? fmt::format("{}, by {} of {}", outcome(), taken, counted(tried, "trial", "trials"))
                               : fmt::format("none of {} was as good", counted(tried, "trial", "trials"));
        return taken > 0;
    }

    /// The surface through the nodes of a grid, which is judged as exactly as the best one now.
    bool take_interpolation(AttemptReport& own)
    {
        best_->judgement = judge_.judge(best_->surface, true, progress_.part(0.9, 0.95));
        std::optional<NurbsSurface> through = through_all(source_, options_);
        if (!through) {
            own.reason = "no nodes of a grid, or too many";
            return false;
        }
        Judgement judgement = judge_.judge(*through, true, progress_.part(0.95, 1));
        own.reason = "farther from the part";
        if (!better(judgement))
            return false;
        best_ = Best{std::move(*through), source_.lines_u, source_.lines_v, std::move(judgement)};
        own.reason = outcome();
        return true;
    }

    FitResult result(std::vector<AttemptReport> attempts)
    {
        FitResult result;
        result.report = std::move(report_);
        result.report.attempts = std::move(attempts);
        result.report.reached = within();
        if (!result.report.reached)
            result.report.shortfall = shortfall_of(best_->surface, best_->judgement, mesh_, options_, out_of_points_);
        result.surface = std::move(best_->surface);
        result.u = std::move(best_->u);
        result.v = std::move(best_->v);
        result.deviation = std::move(best_->judgement.deviation);
        result.report.knots_u = result.surface.count_u - result.surface.degree_u - 1;
        result.report.knots_v = result.surface.count_v - result.surface.degree_v - 1;
        return result;
    }

private:
    struct Best {
        NurbsSurface surface;
        std::vector<double> u, v;
        Judgement judgement;
    };

    SpanBorders first_spans() const
    {
        // Points that slide need fewer knots than the border has where they stay.
        if (corrected())
            return {first_borders(options_.ends), first_borders(options_.ends)};
        return {borders_of_sides(source_, options_, true), borders_of_sides(source_, options_, false)};
    }

    Attempt fitted(const SpanBorders& borders, const Progress& part) const
    {
        Attempt result = attempt(source_, options_, borders.u, borders.v, part);
        if (projection_)
            correct_parameters(result, *projection_, part);
        return result;
    }

    bool better(const Judgement& now) const
    {
        if (!best_ || now.within != best_->judgement.within)
            return !best_ || now.within;
        // More knots than the tolerance needs are worth it only where they take every fold away.
        return now.within ? now.deviation.turned.empty() && !best_->judgement.deviation.turned.empty()
                          : now.deviation.max() < best_->judgement.deviation.max();
    }

    void take(Attempt& now, Judgement judgement)
    {
        best_ = Best{std::move(now.surface), now.along_u.parameters(), now.along_v.parameters(), std::move(judgement)};
    }

    std::string outcome() const
    {
        return fmt::format("{} the tolerance{} with {} x {} control points", within() ? "within" : "beyond",
                           best_->judgement.deviation.turned.empty() ? "" : ", folded,", best_->surface.count_u,
                           best_->surface.count_v);
    }

    const FitSource& source_;
    const TriMesh& mesh_;
    const FitOptions& options_;
    const Progress& progress_;
    FitJudge judge_;
    std::optional<FootPointProjection> projection_; ///< where parameters are corrected
    std::optional<Best> best_;
    FitReport report_;
    bool out_of_points_ = false;
};

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
    FitSearch search(source, mesh, options, progress);
    const auto within = [&] { return search.within(); };
    const auto go_on = [] { return false; };
    // Halving gives more than is needed: where two halves are far better than asked for, they are
    // joined again. Spans of even change can be fewer than halved ones.
    const auto halve = [&](AttemptReport& own) { return search.halve_spans(own); };
    const auto merge = [&](AttemptReport& own) {
        return search.take_fewer(SpanMerging(mesh, options), "merging to", own);
    };
    const auto equidistribute = [&](AttemptReport& own) {
        return search.take_fewer(KnotEquidistribution(source, options), "distributing the knots of", own);
    };
    const auto remove = [&](AttemptReport& own) {
        return search.take_fewer(KnotRemoval(options), "removing knots down to", own);
    };
    const auto interpolate = [&](AttemptReport& own) { return search.take_interpolation(own); };
    return search.result(try_in_order({{"spans halved", {}, halve, go_on},
                                       {"spans merged", within, merge, go_on},
                                       {"knots equidistributed", within, equidistribute, go_on},
                                       {"knots removed", [&] { return within() && search.corrected(); }, remove, go_on},
                                       {"nodes interpolated", [&] { return !within(); }, interpolate, go_on}}));
}

} // namespace spia
