#include "engine/forming/load_steps.h"

#include <algorithm>
#include <fmt/core.h>
#include <optional>

#include "engine/forming/equilibrium.h"
#include "engine/forming/sheet_fields.h"

namespace spia {
namespace {

const std::string forces_act = "under the forces of the tools a sheet that softens would neck";

/// The forces from none on in steps, each from the blank of the one before, as far as equilibrium is found.
/// @param report  of all the forces at once, which had no solution; keeps its steps, and all else if there is none without
///                forces either
std::optional<Eigen::Matrix2Xd> in_steps(const Job& job, const Eigen::Matrix2Xd& X, SolveReport& report,
                                         const Progress& progress)
{
    const ExternalForces whole = job.external;
    job.external = whole.scaled(0);
    SolveReport share = report;
    Eigen::Matrix2Xd reached = solve_at_once(job, X, share, progress.part(0, 0.3));
    report.energy = share.energy;
    report.newton = share.newton;
    if (share.system == SolvedSystem::energy) {
        job.external = whole;
        return std::nullopt;
    }
    const Sheet sheet = sheet_with(job, Curve::continued);
    EquilibriumOptions newton{std::min(30, job.options.most_newton_steps), job.options.tolerance, job.options.watch};
    newton.patient = false;
    // What the sheet bears is found to two percent of it, however much was asked for.
    constexpr double found = 0.02, nothing = 1e-5;
    constexpr int most_tries = 60;
    double step = 0.5;
    share.process_share = 0;
    for (int tries = 0; tries < most_tries && share.process_share < 1; ++tries) {
        if (step < std::max(found * share.process_share, nothing))
            break;
        const double wanted = std::min(1., share.process_share + step);
        job.external = whole.scaled(wanted);
        VirtualWork work(job.part, job.element, sheet, job.external);
        const Progress part = progress.part(0.3 + 0.7 * tries / most_tries, 0.3 + 0.7 * (tries + 1) / most_tries);
        EquilibriumResult result =
            share.system == SolvedSystem::relaxed
                ? solve_relaxed_equilibrium(job.part, job.element, work, reached, job.matrix, job.cholesky, newton,
                                            part)
                : solve_equilibrium(job.part, job.element, work, reached, job.matrix, job.cholesky, newton, part);
        report.newton.insert(report.newton.end(), result.steps.begin(), result.steps.end());
        if (result.ended != Ended::converged) {
            step /= 4;
            continue;
        }
        share.process_share = wanted;
        step *= 2;
        share.relaxed_vertices = int(std::count(work.relaxed().begin(), work.relaxed().end(), char(1)));
        share.residual = result.residual;
        share.resultant = result.resultant;
        reached = std::move(result.position);
    }
    share.energy = std::move(report.energy);
    share.newton = std::move(report.newton);
    report = std::move(share);
    return reached;
}

/// Says with which curve it was solved, and how much of it the sheet bears.
void tell(const Job& job, const Eigen::Matrix2Xd& blank, SolveReport& report)
{
    const SheetFields face = face_fields(job.part, job.element, {blank}, sheet_with(job, Curve::continued));
    const int beyond = face.necking.sum();
    if (report.system == SolvedSystem::strict && beyond > 0)
        report.system = SolvedSystem::continued;
    else if (beyond == 0) // nothing of the continuation is in it
        report.trusted_strain = job.options.curve.trusted_strain;
    report.reason = converged_in_words(report, forces_act, job.options.curve.trusted_strain, job.part.vertices());
    if (report.process_share == 0)
        report.reason +=
            "; too much force: with next to nothing of it no equilibrium was found on this mesh, and the blank has none of it";
    else if (report.process_share < 1)
        report.reason += fmt::format(
            "; too much force: beyond {:.2g} % of it no equilibrium was found on this mesh, and the blank has that much",
            100 * report.process_share);
}

} // namespace

Eigen::Matrix2Xd solve(const Job& job, const Eigen::Matrix2Xd& X, SolveReport& report, const Progress& progress)
{
    if (!job.external.any())
        return solve_at_once(job, X, report, progress);
    Eigen::Matrix2Xd blank = solve_at_once(job, X, report, progress.part(0, 0.6));
    if (report.system == SolvedSystem::energy) {
        std::optional<Eigen::Matrix2Xd> stepped = in_steps(job, X, report, progress.part(0.6, 1));
        if (!stepped) {
            report.process_share = 0;
            report.reason += "; the forces of the tools are not in it";
            return blank;
        }
        blank = std::move(*stepped);
    }
    tell(job, blank, report);
    return blank;
}

} // namespace spia
