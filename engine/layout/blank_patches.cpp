#include <algorithm>
#include <exception>
#include <fmt/core.h>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/layout/fit_patches.h"
#include "engine/layout/patches_judge.h"
#include "engine/layout/simplify/simplify_layout.h"
#include "engine/layout/smooth_fit.h"
#include "engine/mesh/topology.h"
#include "engine/nurbs/certificate.h"

namespace spia {

namespace {

/// A way to divide a blank.
struct Division {
    std::string name;
    LayoutOptions layout;
    bool simplified = false;    ///< with as few patches as simplify_layout() leaves
    bool without_edges = false; ///< the same as the one before but without the edges of the part
};

/// Simplified layouts, then as few patches as lines alone make, then more of them with better
/// corners; each along the edges of the part, where it has some, and without; along flatter edges
/// where these are not enough; at last with every face divided. A part without holes is tried with
/// lines alone first. Corners that the user gave make the layout theirs: it is not simplified.
std::vector<Division> divisions(const TriMesh& part, const LayoutOptions& layout)
{
    constexpr double flat_deg = 20; // flatter ones are bends that a smooth surface follows
    LayoutOptions plain = layout, flat = layout;
    plain.edge_deg = 180;
    flat.edge_deg = std::min(layout.edge_deg, flat_deg);
    const int edges = edge_count(part, layout), flat_edges = layout.edge_deg < 180 ? edge_count(part, flat) : 0;
    std::vector<Division> result;
    const auto add = [&](std::string name, const LayoutOptions& from, bool layers, bool split, double corner,
                         double closer) {
        result.push_back({std::move(name), from});
        LayoutOptions& own = result.back().layout;
        own.layers = layers;
        own.split = split;
        own.corner_deg *= corner;
        own.spacing *= closer;
    };
    const auto add_both = [&](const std::string& name, bool layers, double closer) {
        if (edges > 0)
            add(name + " along the edges", layout, layers, false, 1, closer);
        add(name, plain, layers, false, 1, closer);
        result.back().without_edges = edges > 0;
    };
    const auto add_simplified = [&] {
        const size_t first = result.size();
        add_both("simplified", true, 1);
        if (flat_edges > edges)
            add("simplified along flatter edges", flat, true, false, 1, 1);
        for (size_t k = first; k < result.size(); ++k)
            result[k].simplified = true;
    };
    // Without holes lines alone may make one patch, or one on each side of an edge.
    const bool holes = boundary_loops(part).size() > 1;
    if (layout.corners.empty() && holes)
        add_simplified();
    add_both("few patches", false, 1);
    if (layout.corners.empty() && !holes)
        add_simplified();
    add_both("layers", true, 1);
    if (flat_edges > edges) {
        add("few patches along flatter edges", flat, false, false, 1, 1);
        add("layers along flatter edges", flat, true, false, 1, 1);
    }
    add_both("layers of closer vertices", true, 0.5);
    add("every face divided", plain, false, true, 1, 1);
    // other vertices on the border, where a face has a corner without room for cells
    add("every face divided, closer vertices", plain, false, true, 1, 0.5);
    add("every face divided, closer vertices, fewer corners", plain, false, true, 1.5, 0.5);
    add("layers, every face divided", plain, true, true, 1, 1);
    return result;
}

/// What a fit is worth: no fold, then the tolerance, then its shape, then few control points, or to
/// be near.
struct Worth {
    bool suited = false, reached = false;
    double least_scaled = 0; ///< scaled Jacobian
    double deviation = std::numeric_limits<double>::infinity();
    int control_points = std::numeric_limits<int>::max();

    bool all() const { return suited && reached; }
    bool shaped() const { return least_scaled >= well_shaped_jacobian; }
    bool better_than(const Worth& other) const
    {
        if (all() && other.all())
            return std::tuple(shaped(), -control_points) > std::tuple(other.shaped(), -other.control_points);
        return std::tuple(suited, reached, -deviation) > std::tuple(other.suited, other.reached, -other.deviation);
    }
};

Worth worth_of(const PatchesFit& fit, const Progress& progress)
{
    const Certificate certificate = certify(fit.patches, progress);
    return {certificate.suited(), fit.reached, certificate.poorest().least_scaled, fit.deviation_max(),
            shared_controls(fit.patches).count};
}

bool same(const Layout& a, const Layout& b)
{
    return a.patch == b.patch && std::equal(a.curve.begin(), a.curve.end(), b.curve.begin(), b.curve.end(),
                                            [](const LayoutCurve& c, const LayoutCurve& d) {
                                                return c.vertex == d.vertex && c.plane.cols() == d.plane.cols() &&
                                                       c.plane == d.plane;
                                            });
}

/// What a fit came to, in words.
std::string describe(const Worth& worth, size_t patches)
{
    return fmt::format(
        "{}: {}", counted(patches, "patch", "patches"),
        !worth.suited ? "not proved to have no fold"
        : !worth.reached
            ? fmt::format("{:.3g} mm from the part with {} control points", worth.deviation, worth.control_points)
            : fmt::format("within the tolerance with {} control points, least scaled Jacobian {:.2g}",
                          worth.control_points, worth.least_scaled));
}

/// The divisions that were tried so far, and the best fit of them.
class DivisionSearch {
public:
    DivisionSearch(const TriMesh& part, const Blank& blank, const PatchesFitOptions& options)
        : part_(part), blank_(blank), options_(options)
    {
    }

    /// Patches along edges are compared with those without, whose fit may cost no more. Where
    /// patches have no fold but stay beyond the tolerance, what lacks is control points, or an edge
    /// is in the way whatever the patches: dividing every face does not help. One patch on a round
    /// blank has no angle at its corners, which are better put inside.
    bool worth_trying(const Division& division) const
    {
        return compares(division) || betters_shape(division) ||
               !(worth_.all() || (worth_.suited && division.layout.split));
    }

    /// @returns whether it is the best so far
    bool try_division(const Division& division, AttemptReport& own, const Progress& progress)
    {
        Layout divided = division.simplified ? simplified(division.layout, progress.part(0, 0.4), own)
                                             : make_layout(part_, blank_, division.layout, progress.part(0, 0.1));
        if (same(divided, last_)) {
            own.reason = "the same patches as before";
            return false;
        }
        last_ = divided;
        PatchesFitOptions fitting = options_;
        if (compares(division))
            fitting.max_control_points = std::min(options_.max_control_points, worth_.control_points);
        // More: the patches are too large for the tolerance, and knots in their strips dear.
        constexpr int most_of_a_patch = 500, dearest_shape = 2;
        if (betters_shape(division))
            fitting.max_control_points = std::min(options_.max_control_points, dearest_shape * worth_.control_points);
        else if (division.simplified && !compares(division))
            fitting.max_control_points =
                std::min(fitting.max_control_points, most_of_a_patch * int(divided.patch.size()));
        PatchesFit fit = fit_patches(part_, blank_, divided, fitting, progress.part(0.4, 1));
        const Worth now = worth_of(fit, progress.part(1, 1));
        std::ranges::move(fit.attempts, std::back_inserter(own.within));
        own.reason = describe(now, divided.patch.size());
        if (best_ && !now.better_than(worth_))
            return false;
        best_ = std::move(fit);
        best_is_simplified_ = division.simplified;
        worth_ = now;
        return true;
    }

    std::optional<PatchesFit> best() { return std::move(best_); }

private:
    bool compares(const Division& division) const
    {
        return worth_.all() && best_->layout.edges > 0 && division.without_edges &&
               division.simplified == best_is_simplified_;
    }

    bool betters_shape(const Division& division) const
    {
        return worth_.all() && !worth_.shaped() && !best_is_simplified_ && division.simplified;
    }

    /// From layers, which have no flat corners; where there is no room for them from few patches.
    Layout simplified(LayoutOptions layout, const Progress& progress, AttemptReport& own) const
    {
        SimplifyOptions options;
        // An arc of this radius in the place of a corner is off by the tolerance.
        layout.corner_radius = options.corner_radius = options_.tolerance / (std::numbers::sqrt2 - 1);
        options.corner_deg = layout.corner_deg;
        Layout start;
        const auto lay = [&](bool layers) {
            return [&, layers](AttemptReport&) {
                layout.layers = layers;
                options.refine = !layers;
                start = make_layout(part_, blank_, layout, progress.part(0, 0.2));
                return true;
            };
        };
        PlannedAttempt layers{"starting from layers", {}, lay(true)}, few{"starting from few patches", {}, lay(false)};
        layers.may_refuse = true;
        own.within = try_in_order({layers, few});
        return simplify_layout(start, options, progress.part(0.2, 1));
    }

    const TriMesh& part_;
    const Blank& blank_;
    const PatchesFitOptions& options_;
    std::optional<PatchesFit> best_;
    bool best_is_simplified_ = false;
    Worth worth_; ///< of the best
    Layout last_;
};

/// What is in the way of the plainest division, which says most.
/// @param made  of the divisions in their order, some left out
std::exception_ptr telling_refusal(const std::vector<Division>& divisions, const std::vector<AttemptReport>& made)
{
    std::exception_ptr result;
    bool of_simplified = false;
    auto attempt = made.begin();
    for (const Division& division : divisions) {
        if (attempt == made.end() || attempt->name != division.name)
            continue;
        if (attempt->refusal && (!result || of_simplified || division.without_edges)) {
            result = attempt->refusal;
            of_simplified = division.simplified;
        }
        ++attempt;
    }
    return result;
}

PatchesFit best_patches(const TriMesh& part, const Blank& blank, const LayoutOptions& layout,
                        const PatchesFitOptions& options, const Progress& progress)
{
    progress.checkpoint(0, "dividing the blank into patches");
    const std::vector<Division> division = divisions(part, layout);
    const double count = double(division.size());
    DivisionSearch search(part, blank, options);
    std::vector<PlannedAttempt> attempts;
    for (size_t k = 0; k < division.size(); ++k)
        attempts.push_back({division[k].name, [&, k] { return search.worth_trying(division[k]); },
                            [&, k](AttemptReport& own) {
                                return search.try_division(division[k], own,
                                                           progress.part(double(k) / count, double(k + 1) / count));
                            },
                            [] { return false; }, // the others are not worth_trying() then
                            true});
    std::vector<AttemptReport> made = try_in_order(attempts);
    std::optional<PatchesFit> best = search.best();
    if (!best)
        std::rethrow_exception(telling_refusal(division, made));
    best->attempts = std::move(made);
    return std::move(*best);
}

} // namespace

PatchesFit blank_patches(const TriMesh& part, const Blank& blank, const LayoutOptions& layout,
                         const PatchesFitOptions& options, const Progress& progress)
{
    if (!options.smooth_joins)
        return best_patches(part, blank, layout, options, progress);
    PatchesFit fit = best_patches(part, blank, layout, options, progress.part(0, 0.7));
    const PatchesJudge judge(part, blank, fit.layout, options.tolerance, progress.part(0.7, 0.7));
    const PatchesJudgement judged = smooth_fit(fit, judge, judge.judge(fit.patches.patch, progress.part(0.7, 0.75)),
                                               options.tolerance, progress.part(0.75, 1));
    fit.surface_to_mesh = judged.surface_to_mesh;
    fit.mesh_to_surface = judged.mesh_to_surface;
    fit.at_vertex = judged.at_vertex;
    fit.patch_deviation = judged.patch;
    fit.reached = judged.max() <= options.tolerance;
    return fit;
}

} // namespace spia
