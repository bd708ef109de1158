#include "engine/layout/smooth_fit.h"

#include <algorithm>
#include <cmath>

#include "engine/layout/simplify/simplify_layout.h"
#include "engine/nurbs/certificate.h"
#include "engine/nurbs/smooth_joins.h"

namespace spia {

namespace {

constexpr int most_smoothing_rounds = 12; // of trying; then all stay as they were
constexpr int rounds_before_widening = 3; // then those beside spoilt patches are kept as well
constexpr double no_worse = 1e-3;         // radians, by which the angle of a join may grow while
                                          // others get smooth

/// Per patch 1 where it is worse than it may be: too far from the part, folded, ill-shaped, or with
/// a greater angle at one of its sides.
std::vector<char> spoilt(const PatchesJudgement& before, const Certificate& proved, const PatchesJudgement& after,
                         const Certificate& certificate, double tolerance)
{
    std::vector<char> result(before.patch.size(), 0);
    for (size_t p = 0; p < result.size(); ++p)
        result[p] = !(after.patch[p].max <= std::max(tolerance, before.patch[p].max)) ||
                    (certificate.patch[p].refusal && !proved.patch[p].refusal) ||
                    certificate.patch[p].least_scaled < std::min(proved.patch[p].least_scaled, well_shaped_jacobian);
    for (size_t i = 0; i < proved.interfaces.size(); ++i) {
        const InterfaceCertificate &was = proved.interfaces[i], &is = certificate.interfaces[i];
        if (!(is.greatest_angle <= was.greatest_angle + no_worse))
            result[size_t(is.joint.first.patch)] = result[size_t(is.joint.second.patch)] = 1;
    }
    return result;
}

/// The patches and those beside them.
std::vector<char> with_neighbours(std::vector<char> patches, const MultiPatch& all)
{
    const std::vector<char> first = patches;
    for (const PatchInterface& joint : all.interfaces)
        for (const auto& [a, b] :
             {std::pair(joint.first.patch, joint.second.patch), std::pair(joint.second.patch, joint.first.patch)})
            if (first[size_t(a)])
                patches[size_t(b)] = 1;
    return patches;
}

int count(const std::vector<char>& patches) { return int(std::count(patches.begin(), patches.end(), 1)); }

} // namespace

PatchesJudgement smooth_fit(PatchesFit& fit, const PatchesJudge& judge, PatchesJudgement now, double tolerance,
                            const Progress& progress)
{
    const Certificate proved = certify(fit.patches, progress.part(0, 0));
    SmoothJoinsOptions options;
    options.tolerance = tolerance;
    options.kept.assign(fit.patches.patch.size(), 0);
    for (int round = 0;; ++round) {
        const Progress here = progress.part(1 - std::pow(0.7, round), 1 - std::pow(0.7, round + 1));
        SmoothJoins smooth = smooth_joins(fit.patches, options, here.part(0, 0.5));
        fit.joins = {smooth.angle_before, smooth.angle_after, smooth.places, smooth.edges, count(options.kept)};
        if (smooth.greatest_move == 0 || round == most_smoothing_rounds) {
            fit.joins->kept = int(options.kept.size());
            fit.joins->angle_after = smooth.angle_before;
            return now;
        }
        PatchesJudgement then = judge.judge(smooth.patches.patch, here.part(0.5, 1));
        std::vector<char> bad = spoilt(now, proved, then, certify(smooth.patches, here.part(1, 1)), tolerance);
        if (count(bad) == 0) {
            fit.patches = std::move(smooth.patches);
            return then;
        }
        // A place of the part beside a patch that is kept already is nearest to a neighbour that
        // moved.
        const int before = count(options.kept);
        if (round >= rounds_before_widening)
            bad = with_neighbours(bad, fit.patches);
        for (int pass = 0; pass < 2 && count(options.kept) == before; ++pass, bad = with_neighbours(bad, fit.patches))
            for (size_t p = 0; p < bad.size(); ++p)
                options.kept[p] = char(options.kept[p] | bad[p]);
        if (count(options.kept) == before) // none is left that can be blamed
            options.kept.assign(options.kept.size(), 1);
    }
}

} // namespace spia
