#include "engine/layout/fit_patches.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/layout/patches_judge.h"
#include "engine/mesh/locate.h"
#include "engine/nurbs/basis.h"
#include "engine/nurbs/fit_curve.h"
#include "engine/nurbs/fit_patch.h"
#include "engine/nurbs/refinement_indicators.h"
#include "engine/nurbs/span_borders.h"

namespace spia {

namespace {

/// From places of the blank to places of the part.
struct Lift {
    const TriMesh& part;
    PlanarLocator locator;

    Eigen::Vector3d operator()(const MeshPoint& place) const
    {
        Eigen::Vector3d result = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k)
            result += place.barycentric[k] * part.position.col(part.triangle(k, place.face));
        return result;
    }
};

/// What is fitted: curves and patches as sources of points.
class Sources {
public:
    Sources(const TriMesh& part, const Blank& blank, const Layout& layout,
            const std::vector<std::unique_ptr<const PatchGrid>>& grids)
        : layout_(layout), grids_(grids), lift_{part, PlanarLocator(blank.position, part.triangle)},
          vertex_(3, layout.vertex.cols())
    {
        std::vector<char> known(size_t(layout.vertex.cols()), 0);
        for (const LayoutCurve& curve : layout.curve)
            for (const int end : {0, 1}) {
                const int v = curve.vertex[size_t(end)];
                if (curve.on_border())
                    vertex_.col(v) = curve.part.col(end == 0 ? 0 : curve.part.cols() - 1);
                else if (!known[size_t(v)])
                    vertex_.col(v) = lift_(lift_.locator.nearest(layout.vertex.col(v)));
                known[size_t(v)] = char(known[size_t(v)] | (curve.on_border() ? 2 : 1));
            }
        // A vertex on the border is where the border has it, whichever curve came first.
        for (const LayoutCurve& curve : layout.curve)
            if (curve.on_border()) {
                vertex_.col(curve.vertex[0]) = curve.part.col(0);
                vertex_.col(curve.vertex[1]) = curve.part.col(curve.part.cols() - 1);
            }
    }

    Eigen::Matrix3Xd on_curve(int c, const std::vector<double>& t) const
    {
        const LayoutCurve& curve = layout_.curve[size_t(c)];
        Eigen::Matrix3Xd result(3, Eigen::Index(t.size()));
        if (curve.on_border())
            result = part_points_on(curve, t);
        else {
            const Eigen::Matrix2Xd plane = points_on(curve, t);
            for (Eigen::Index i = 0; i < plane.cols(); ++i)
                result.col(i) = lift_(lift_.locator.nearest(plane.col(i)));
        }
        for (size_t i = 0; i < t.size(); ++i) { // curves that meet there have the same point to the
                                                // last bit
            if (t[i] == 0)
                result.col(Eigen::Index(i)) = vertex_.col(curve.vertex[0]);
            if (t[i] == 1)
                result.col(Eigen::Index(i)) = vertex_.col(curve.vertex[1]);
        }
        return result;
    }

    std::vector<MeshPoint> places(int p, const std::vector<double>& u, const std::vector<double>& v) const
    {
        const QuadGrid planar = grids_[size_t(p)]->chart->refined(u, v).planar;
        std::vector<MeshPoint> result(size_t(planar.nodes()));
        parallel_for(planar.nodes(),
                     [&](int n) { result[size_t(n)] = lift_.locator.nearest(planar.position.col(n).head<2>()); });
        for (size_t k = 0; k < 4; ++k) { // sides are the same places for both neighbours
            const CurveUse use = layout_.patch[size_t(p)][k];
            const std::vector<double>& along = k % 2 == 0 ? u : v;
            const bool against = use.reversed != (k >= 2);
            for (size_t i = 0; i < along.size(); ++i) {
                const int at = int(i), m = planar.columns, n = planar.rows;
                const int node = k == 0   ? planar.node(at, 0)
                                 : k == 1 ? planar.node(m, at)
                                 : k == 2 ? planar.node(at, n)
                                          : planar.node(0, at);
                result[size_t(node)] = lift_.locator.nearest(
                    points_on(layout_.curve[size_t(use.curve)], {against ? 1 - along[i] : along[i]}).col(0));
            }
        }
        return result;
    }

    Eigen::Matrix3Xd lifted(const std::vector<MeshPoint>& places) const
    {
        Eigen::Matrix3Xd result(3, Eigen::Index(places.size()));
        for (size_t n = 0; n < places.size(); ++n)
            result.col(Eigen::Index(n)) = lift_(places[n]);
        return result;
    }

private:
    const Layout& layout_;
    const std::vector<std::unique_ptr<const PatchGrid>>& grids_;
    Lift lift_;
    Eigen::Matrix3Xd vertex_; ///< of the layout, on the part
};

/// The spans of every strip.
class Strips {
public:
    Strips(const Chords& chords, CurveEnds ends) : chords_(chords), borders_(size_t(chords.strips), first_borders(ends))
    {
    }

    std::vector<double> of_curve(int c) const
    {
        const auto& borders = borders_[size_t(chords_.strip[size_t(c)])];
        return chords_.against[size_t(c)] ? mirrored(borders) : borders;
    }
    /// As the parameter of a patch runs: sides v = 0 and u = 1 along it, v = 1 and u = 0 against
    /// it.
    std::vector<double> of_side(const LayoutPatch& patch, size_t side) const
    {
        const auto borders = of_curve(patch[side].curve);
        return (patch[side].reversed != (side >= 2)) ? mirrored(borders) : borders;
    }
    /// More borders for the strip of a curve, in the direction of the curve.
    void unite(int c, std::vector<double> borders)
    {
        if (chords_.against[size_t(c)])
            borders = mirrored(borders);
        const int s = chords_.strip[size_t(c)];
        borders_[size_t(s)] = united(borders_[size_t(s)], borders);
        if (chords_.symmetrical[size_t(s)])
            borders_[size_t(s)] = united(borders_[size_t(s)], mirrored(borders_[size_t(s)]));
    }
    const std::vector<std::vector<double>>& borders() const { return borders_; }
    void set(std::vector<std::vector<double>> borders) { borders_ = std::move(borders); }

private:
    const Chords& chords_;
    std::vector<std::vector<double>> borders_;
};

/// One fit over given spans.
struct Fitted {
    MultiPatch patches;
    std::vector<CurveFit> along_u, along_v;
    std::vector<Eigen::Matrix3Xd> points;
    std::vector<std::vector<MeshPoint>> place;
};

Eigen::Matrix3Xd backwards(const Eigen::Matrix3Xd& control) { return control.rowwise().reverse(); }

Fitted fit_over(const Strips& strips, const Layout& layout, const Sources& sources, const PatchesFitOptions& options,
                const Progress& progress)
{
    CurveFitOptions of_curve;
    of_curve.tolerance = options.tolerance;
    of_curve.degree = options.degree;
    std::vector<Eigen::Matrix3Xd> curve;
    for (int c = 0; c < int(layout.curve.size()); ++c)
        curve.push_back(curve_over(
                            strips.of_curve(c), [&](const auto& t) { return sources.on_curve(c, t); }, of_curve)
                            .control);
    Fitted result;
    std::vector<NurbsSurface> patches;
    for (int p = 0; p < int(layout.patch.size()); ++p) {
        progress.checkpoint(double(p) / double(layout.patch.size()), fmt::format("fitting patch {}", p + 1));
        const LayoutPatch& patch = layout.patch[size_t(p)];
        const std::vector<double> borders_u = strips.of_side(patch, 0), borders_v = strips.of_side(patch, 1);
        const std::vector<double> u = data_parameters(borders_u, {}), v = data_parameters(borders_v, {});
        result.along_u.emplace_back(clamped_knots(borders_u, options.degree), options.degree, CurveEnds::averaged_knots,
                                    u);
        result.along_v.emplace_back(clamped_knots(borders_v, options.degree), options.degree, CurveEnds::averaged_knots,
                                    v);
        PatchBorders borders;
        for (size_t k = 0; k < 4; ++k)
            borders[k] = patch[k].reversed != (k >= 2) ? backwards(curve[size_t(patch[k].curve)])
                                                       : curve[size_t(patch[k].curve)];
        result.place.push_back(sources.places(p, u, v));
        result.points.push_back(sources.lifted(result.place.back()));
        patches.push_back(fit_patch(result.points.back(), result.along_u.back(), result.along_v.back(), borders));
    }
    result.patches = joined(std::move(patches));
    return result;
}

double control_points(const Strips& strips, const Layout& layout, int degree)
{
    const auto along = [&](const LayoutPatch& patch, size_t side) {
        return double(strips.of_side(patch, side).size()) - 1 + degree;
    };
    double count = 0;
    for (const LayoutPatch& patch : layout.patch)
        count += along(patch, 0) * along(patch, 1);
    return count;
}

/// Halves the spans of a patch that want to be, in whole strips.
void refine_for(int p, Strips& strips, const Strips& before, const Layout& layout, const Fitted& fitted,
                const PatchesJudgement& judgement)
{
    const RefinementIndicators urgency =
        refinement_indicators(fitted.patches.patch[size_t(p)], judgement.missing[size_t(p)], fitted.points[size_t(p)],
                              fitted.along_u[size_t(p)], fitted.along_v[size_t(p)]);
    for (const size_t k : {size_t(0), size_t(1)}) {
        const CurveUse use = layout.patch[size_t(p)][k];
        const std::vector<double> borders = before.of_side(layout.patch[size_t(p)], k);
        const std::vector<double>& wanted = k == 0 ? urgency.u : urgency.v;
        std::vector<char> halve(wanted.size(), 0);
        for (size_t s = 0; s < wanted.size(); ++s)
            halve[s] = wanted[s] > 0 && may_halve(borders[s], borders[s + 1], {});
        const std::vector<double> more = halved(borders, halve);
        strips.unite(use.curve, use.reversed ? mirrored(more) : more);
    }
}

/// The spans halved that want to be, as far as the control points go: those of the farthest patches
/// first.
/// @returns false if none may be
bool refine(Strips& strips, const Layout& layout, const Fitted& fitted, const PatchesJudgement& judgement,
            const PatchesFitOptions& options)
{
    std::vector<int> order;
    for (int p = 0; p < int(layout.patch.size()); ++p)
        if (!judgement.missing[size_t(p)].empty())
            order.push_back(p);
    std::stable_sort(order.begin(), order.end(),
                     [&](int p, int q) { return judgement.patch[size_t(p)].max > judgement.patch[size_t(q)].max; });
    const Strips before = strips;
    Strips all = strips;
    for (const int p : order)
        refine_for(p, all, before, layout, fitted, judgement);
    if (control_points(all, layout, options.degree) <= options.max_control_points)
        strips.set(all.borders());
    else
        for (const int p : order) {
            Strips next = strips;
            refine_for(p, next, before, layout, fitted, judgement);
            if (control_points(next, layout, options.degree) <= options.max_control_points)
                strips.set(next.borders());
        }
    return strips.borders() != before.borders();
}

/// The spans that the curves need for themselves: within the tolerance, or as near as the control
/// points allow.
Strips first_strips(const Layout& layout, const Chords& chords, const Sources& sources,
                    const PatchesFitOptions& options)
{
    constexpr double farthest = 1e6; // times the tolerance: no curve has more than one span then
    CurveFitOptions of_curve;
    of_curve.degree = options.degree;
    of_curve.most_spans = 512;
    for (double looser = 1;; looser *= 4) {
        Strips strips(chords, CurveEnds::averaged_knots);
        of_curve.tolerance = looser * options.tolerance;
        for (int c = 0; c < int(layout.curve.size()); ++c)
            strips.unite(c, fit_curve([&](const auto& t) { return sources.on_curve(c, t); }, of_curve).borders);
        if (looser > farthest || control_points(strips, layout, options.degree) <= options.max_control_points)
            return strips;
    }
}

/// Those that were not found at once.
std::vector<AttemptReport> searched_grids(const std::vector<std::unique_ptr<const PatchGrid>>& grids)
{
    std::vector<AttemptReport> searched;
    for (size_t p = 0; p < grids.size(); ++p) {
        const std::vector<AttemptReport>& attempts = grids[p]->grid.attempts;
        if (attempts.size() == 1 && attempts[0].within.size() == 1)
            continue;
        AttemptReport& grid = searched.emplace_back();
        grid.name = fmt::format("grid of patch {}", p + 1);
        grid.reason = attempts.back().reason;
        grid.won = true;
        grid.within = attempts;
        for (const AttemptReport& each : attempts)
            grid.seconds += each.seconds;
    }
    return searched;
}

} // namespace

PatchesFit fit_patches(const TriMesh& part, const Blank& blank, const Layout& layout, const PatchesFitOptions& options,
                       const Progress& progress)
{
    if (!(options.tolerance > 0) || !std::isfinite(options.tolerance) || options.degree < 2 || options.degree > 5)
        throw InputError(fmt::format(
            "patches of degree {} within {} mm cannot be fitted; choose a degree from 2 to 5 and a positive "
            "tolerance",
            options.degree, options.tolerance));
    const Chords chords = chords_of(layout);
    const auto grids = patch_grids(layout, chords, options.grid, progress.part(0, 0.3));
    const Sources sources(part, blank, layout, grids);
    const PatchesJudge judge(part, blank, layout, options.tolerance);

    Strips strips = first_strips(layout, chords, sources, options);
    PatchesFit result;
    result.attempts = searched_grids(grids);
    std::optional<PatchesJudgement> best;
    for (int round = 1; round <= options.most_rounds; ++round) {
        const double from = 0.3 + 0.7 * (1 - std::pow(0.8, round - 1)), to = 0.3 + 0.7 * (1 - std::pow(0.8, round));
        Fitted fitted = fit_over(strips, layout, sources, options, progress.part(from, (from + to) / 2));
        PatchesJudgement now = judge.judge(fitted.patches.patch, progress.part((from + to) / 2, to));
        result.rounds = round;
        const bool better = !best || now.max() < best->max();
        const bool more = now.max() > options.tolerance && refine(strips, layout, fitted, now, options);
        if (better) {
            result.patches = std::move(fitted.patches);
            result.place = std::move(fitted.place);
            result.u.clear();
            result.v.clear();
            for (size_t p = 0; p < layout.patch.size(); ++p) {
                result.u.push_back(fitted.along_u[p].parameters());
                result.v.push_back(fitted.along_v[p].parameters());
            }
            best = std::move(now);
        }
        if (!more)
            break;
    }
    result.layout = layout;
    result.surface_to_mesh = best->surface_to_mesh;
    result.mesh_to_surface = best->mesh_to_surface;
    result.at_vertex = best->at_vertex;
    result.patch_deviation = best->patch;
    result.reached = best->max() <= options.tolerance;
    require_watertight(result.patches);
    return result;
}

} // namespace spia
