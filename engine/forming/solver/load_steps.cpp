#include "engine/forming/solver/load_steps.h"

#include <algorithm>
#include <fmt/core.h>
#include <optional>

#include "engine/core/text.h"
#include "engine/forming/solver/equilibrium.h"
#include "engine/forming/solver/sheet_fields.h"

namespace spia {
namespace {

/// The forces from none on in steps, each from the blank of the one before, as far as equilibrium
/// is found.
/// @param report  of all the forces at once, which had no solution; keeps its steps, and all else
/// if there is none without
///                forces either
std::optional<Eigen::Matrix2Xd> in_steps(SolveContext& context, const Eigen::Matrix2Xd& X, SolveReport& report,
                                         AttemptReport& own, const Progress& progress)
{
    const ExternalForces whole = context.external;
    context.external = whole.scaled(0);
    SolveReport share = report;
    Eigen::Matrix2Xd reached = solve_at_once(context, X, share, progress.part(0, 0.3));
    report.energy = share.energy;
    report.newton = share.newton;
    own.within = std::move(share.attempts);
    if (share.system == SolvedSystem::energy) {
        own.reason = "no equilibrium without forces either";
        context.external = whole;
        return std::nullopt;
    }
    const Sheet sheet = sheet_with(context, Curve::continued);
    EquilibriumOptions newton{std::min(30, context.options.most_newton_steps), context.options.tolerance,
                              context.watch};
    newton.allow_lu = false;
    newton.stall_steps = 25;
    // Until one hundredth of what is reached was too much, however much was asked for.
    constexpr double fine = 0.01, nothing = 1e-5;
    constexpr int most_tries = 60;
    double step = 0.5;
    share.process_share = 0;
    int tries = 0;
    for (; tries < most_tries && share.process_share < 1; ++tries) {
        if (step < std::max(fine * share.process_share, nothing))
            break;
        const double wanted = std::min(1., share.process_share + step);
        context.external = whole.scaled(wanted);
        VirtualWork work(context.part, context.element, sheet, context.external);
        const Progress part = progress.part(0.3 + 0.7 * tries / most_tries, 0.3 + 0.7 * (tries + 1) / most_tries);
        EquilibriumResult result = share.system == SolvedSystem::relaxed
                                       ? solve_relaxed_equilibrium(context.part, context.element, work, reached,
                                                                   context.matrix, context.cholesky, newton, part)
                                       : solve_equilibrium(context.part, context.element, work, reached, context.matrix,
                                                           context.cholesky, newton, part);
        report.newton.insert(report.newton.end(), result.steps.begin(), result.steps.end());
        if (result.ended != Ended::converged) {
            step /= 2;
            continue;
        }
        share.process_share = wanted;
        step *= 1.5;
        share.relaxed_vertices = int(std::count(work.relaxed().begin(), work.relaxed().end(), char(1)));
        share.residual = result.residual;
        share.resultant = result.resultant;
        reached = std::move(result.position);
    }
    if (share.process_share > 0) // solved with this curve, whatever the solution without forces was
                                 // found with
        share.trusted_strain = trusted_strain(context, Curve::continued, context.options.material.hardening);
    context.external = whole.scaled(share.process_share); // what is in the blank, for who goes on
                                                          // from it
    own.reason = fmt::format("{:.2g} % of the forces after {}", 100 * share.process_share,
                             counted(tries, "load step", "load steps"));
    share.energy = std::move(report.energy);
    share.newton = std::move(report.newton);
    report = std::move(share);
    return reached;
}

/// Says with which curve it was solved, and how much of the forces is in it.
void describe_result(const SolveContext& context, const Eigen::Matrix2Xd& blank, SolveReport& report)
{
    const double asked = context.options.curve.trusted_strain;
    const SheetFields face = face_fields(context.part, context.element, {blank}, solved_sheet(context, report));
    const bool beyond = face.necking.sum() > 0;
    if (report.system == SolvedSystem::strict && beyond && report.trusted_strain < asked)
        report.system = SolvedSystem::continued;
    const std::string obstacle =
        report.trusted_strain > trusted_strain(context, Curve::continued, context.options.material.hardening)
            ? fmt::format("the tool forces reach {:.2g} % of what tears the sheet", 100 * context.pull)
            : "pulled so hard a sheet that softens would neck";
    report.reason = describe_convergence(report, beyond ? obstacle : "", beyond ? asked : report.trusted_strain,
                                         context.part.vertices());
    add_share(report);
}

} // namespace

void add_share(SolveReport& report)
{
    if (report.process_share == 0)
        report.reason +=
            "; too much force: no equilibrium was found on this mesh with even a small share of it, and the blank is "
            "computed without it";
    else if (report.process_share < 1)
        report.reason += fmt::format("; too much force: applied in steps, {:.2g} % of it was reached on this mesh, and "
                                     "the blank is computed with that",
                                     100 * report.process_share);
}

Eigen::Matrix2Xd solve(SolveContext& context, const Eigen::Matrix2Xd& X, SolveReport& report, const Progress& progress)
{
    if (!context.external.any()) {
        Eigen::Matrix2Xd blank = solve_at_once(context, X, report, progress);
        if (report.system == SolvedSystem::energy && !context.external.held.empty() && !context.anchored)
            report.reason += "; the pilots have no effect";
        return blank;
    }
    Eigen::Matrix2Xd blank;
    const auto at_once = [&](AttemptReport& own) {
        blank = solve_at_once(context, X, report, progress.part(0, 0.6));
        own.within = std::move(report.attempts);
        return true;
    };
    const auto stepwise = [&](AttemptReport& own) {
        std::optional<Eigen::Matrix2Xd> stepped = in_steps(context, X, report, own, progress.part(0.6, 1));
        if (stepped)
            blank = std::move(*stepped);
        return stepped.has_value();
    };
    const auto in_equilibrium = [&] { return report.system != SolvedSystem::energy; };
    report.attempts =
        try_in_order({{"all forces at once", {}, at_once, in_equilibrium}, {"forces in load steps", {}, stepwise}});
    if (!in_equilibrium()) {
        report.process_share = 0;
        report.reason += "; the tool forces are not applied";
        if (!context.external.held.empty() && !context.anchored)
            report.reason += ", and the pilots have no effect";
        return blank;
    }
    describe_result(context, blank, report);
    return blank;
}

} // namespace spia
