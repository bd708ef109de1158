#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/layout/fit_patches.h"
#include "engine/layout/patches_judge.h"
#include "engine/layout/smooth_fit.h"
#include "engine/nurbs/certificate.h"

namespace spia {

namespace {

/// Ways to divide a blank, in turn.
struct Ways {
    std::vector<LayoutOptions> layout;
    size_t dividing_all = 0; ///< from here on every face is divided: only where a fold is in the
                             ///< way
};

/// As few patches as there can be, then more of them with better corners; each along the edges of
/// the part, where it has some, and without; along flatter edges where these are not enough.
Ways ways_to_divide(const TriMesh& part, const LayoutOptions& layout)
{
    constexpr double flat_deg = 20; // flatter ones are bends that a smooth surface follows
    LayoutOptions plain = layout, flat = layout;
    plain.edge_deg = 180;
    flat.edge_deg = std::min(layout.edge_deg, flat_deg);
    const int edges = edge_count(part, layout), flat_edges = layout.edge_deg < 180 ? edge_count(part, flat) : 0;
    Ways ways;
    const auto add = [&](const LayoutOptions& from, bool layers, bool split, double corner, double closer) {
        LayoutOptions& way = ways.layout.emplace_back(from);
        way.layers = layers;
        way.split = split;
        way.corner_deg *= corner;
        way.spacing *= closer;
    };
    const auto add_both = [&](bool layers, double closer) {
        if (edges > 0)
            add(layout, layers, false, 1, closer);
        add(plain, layers, false, 1, closer);
    };
    add_both(false, 1);
    add_both(true, 1);
    for (const bool layers : {false, true})
        if (flat_edges > edges)
            add(flat, layers, false, 1, 1);
    add_both(true, 0.5);
    ways.dividing_all = ways.layout.size();
    add(plain, false, true, 1, 1);
    add(plain, false, true, 1, 0.5); // other vertices on the border, where a face has a corner
                                     // without room for cells
    add(plain, false, true, 1.5, 0.5);
    add(plain, true, true, 1, 1);
    return ways;
}

/// What a fit is worth: no fold, then the tolerance, then few control points, or to be near.
struct Worth {
    bool suited = false, reached = false;
    double deviation = std::numeric_limits<double>::infinity();
    int control_points = std::numeric_limits<int>::max();

    bool all() const { return suited && reached; }
    bool better_than(const Worth& other) const
    {
        if (all() && other.all())
            return control_points < other.control_points;
        return std::tuple(suited, reached, -deviation) > std::tuple(other.suited, other.reached, -other.deviation);
    }
};

Worth worth_of(const PatchesFit& fit, const Progress& progress)
{
    return {certify(fit.patches, progress).suited(), fit.reached, fit.deviation_max(),
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

PatchesFit best_patches(const TriMesh& part, const Blank& blank, const LayoutOptions& layout,
                        const PatchesFitOptions& options, const Progress& progress)
{
    progress.checkpoint(0, "dividing the blank into patches");
    std::optional<PatchesFit> best;
    std::optional<InputError> first;
    Worth worth;
    Layout last;
    const Ways ways = ways_to_divide(part, layout);
    const size_t count = ways.layout.size();
    for (size_t k = 0; k < count; ++k) {
        // Patches along edges are compared with those without, whose fit may cost no more.
        const bool compare = worth.all() && best->layout.edges > 0 && k == 1;
        if ((worth.all() && !compare) || (worth.suited && k >= ways.dividing_all))
            break; // what lacks then is control points, or an edge is in the way whatever the
                   // patches
        try {
            const Progress here = progress.part(double(k) / double(count), double(k + 1) / double(count));
            Layout divided = make_layout(part, blank, ways.layout[k], here.part(0, 0.1));
            if (k > 0 && same(divided, last))
                continue; // this way makes no difference
            last = divided;
            PatchesFitOptions fitting = options;
            if (compare)
                fitting.max_control_points = std::min(options.max_control_points, worth.control_points);
            PatchesFit fit = fit_patches(part, blank, divided, fitting, here.part(0.1, 1));
            if (const Worth now = worth_of(fit, here.part(1, 1)); !best || now.better_than(worth)) {
                best = std::move(fit);
                worth = now;
            }
        } catch (const InputError& error) {
            if (!first || k == 1) // that of a way without edges, where the first one has some
                first = error;
        }
    }
    if (!best)
        throw *first;
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
    fit.patch_deviation = judged.patch_max;
    fit.reached = judged.max() <= options.tolerance;
    return fit;
}

} // namespace spia
