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

/// The ways to divide a blank, in turn: patches that end on its edges, where it has some; as few patches as there can be without;
/// then more of them with better corners.
std::vector<LayoutOptions> ways_to_divide(const TriMesh& part, const LayoutOptions& layout)
{
    std::vector<LayoutOptions> ways;
    LayoutOptions plain = layout;
    plain.edge_deg = 180;
    const auto add = [&](const LayoutOptions& from, bool layers, bool split, double corner, double closer) {
        LayoutOptions& way = ways.emplace_back(from);
        way.layers = layers;
        way.split = split;
        way.corner_deg *= corner;
        way.spacing *= closer;
    };
    if (has_edges(part, layout)) {
        add(layout, false, false, 1, 1);
        add(layout, true, false, 1, 1);
        add(layout, true, false, 1, 0.5);
    }
    add(plain, false, false, 1, 1);
    add(plain, true, false, 1, 1);
    add(plain, true, false, 1, 0.5);
    add(plain, false, true, 1, 1);
    add(plain, false, true, 1, 0.5); // other vertices on the border, where a face has a corner without room for cells
    add(plain, false, true, 1.5, 0.5);
    add(plain, true, true, 1, 1);
    return ways;
}

/// What a fit is worth: no fold, then the tolerance, then to be near.
struct Worth {
    bool suited = false, reached = false;
    double deviation = std::numeric_limits<double>::infinity();

    bool all() const { return suited && reached; }
    bool better_than(const Worth& other) const
    {
        return std::tuple(suited, reached, -deviation) > std::tuple(other.suited, other.reached, -other.deviation);
    }
};

PatchesFit best_patches(const TriMesh& part, const Blank& blank, const LayoutOptions& layout,
                        const PatchesFitOptions& options, const Progress& progress)
{
    progress.checkpoint(0, "dividing the blank into patches");
    std::optional<PatchesFit> best;
    std::optional<InputError> first;
    Worth best_worth;
    Layout last;
    const std::vector<LayoutOptions> ways = ways_to_divide(part, layout);
    for (size_t k = 0; k < ways.size() && !best_worth.all(); ++k) {
        const Progress here = progress.part(double(k) / double(ways.size()), double(k + 1) / double(ways.size()));
        try {
            Layout divided = make_layout(part, blank, ways[k]);
            if (k > 0 && divided.patch == last.patch && divided.vertex.cols() == last.vertex.cols() &&
                divided.vertex == last.vertex)
                continue; // this way makes no difference
            last = divided;
            PatchesFit fit = fit_patches(part, blank, divided, options, here);
            const Worth now{certify(fit.patches).suited(), fit.reached, fit.deviation_max()};
            if (!best || now.better_than(best_worth)) {
                best = std::move(fit);
                best_worth = now;
            }
            if (k >= 2 && best_worth.suited)
                break; // it is control points that lack, or flatter edges that are in the way, whatever the patches
        } catch (const InputError& error) {
            if (!first)
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
    const PatchesJudge judge(part, blank, fit.layout, options.tolerance);
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
