#include "engine/forming/load_steps.h"

#include <algorithm>
#include <fmt/core.h>
#include <optional>

#include "engine/forming/equilibrium.h"
#include "engine/forming/sheet_fields.h"

namespace spia {
namespace {

/// The forces from none on in steps, each from the blank of the one before, as far as equilibrium is found.
/// @param report  of all the forces at once, which had no solution; keeps its steps, and all else if there is none without
///                forces either
std::optional<Eigen::Matrix2Xd> in_steps(const Job& job, const Eigen::Matrix2Xd& X, SolveReport& report,
                                         const Progress& progress)
{
    const ExternalForces whole = job.external;
    job.external = whole.scaled(0);
    SolveReport share = report;
    Eigen::Matrix2Xd reached = solve_at_once(job, X, share, progress.part(0, 0.4));
    report.energy = share.energy;
    report.newton = share.newton;
    if (share.system == SolvedSystem::energy) {
        job.external = whole;
        return std::nullopt;
    }
    // A sheet that softens would gather its strain in rows of single elements near the greatest force.
    const Sheet sheet = sheet_with(job, hardening_on(job.options));
    EquilibriumOptions newton{std::min(30, job.options.most_newton_steps), job.options.tolerance, job.options.watch};
    newton.patient = false;
    constexpr int most_tries = 10;
    double step = 0.5;
    share.process_share = 0;
    for (int tries = 0; tries < most_tries && share.process_share < 1; ++tries) {
        const double wanted = std::min(1., share.process_share + step);
        job.external = whole.scaled(wanted);
        VirtualWork work(job.part, job.element, sheet, job.external);
        const Progress part = progress.part(0.4 + 0.6 * tries / most_tries, 0.4 + 0.6 * (tries + 1) / most_tries);
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
    if (share.process_share > 0) {
        share.trusted_strain = sheet.law.front().curve().trusted_strain();
        if (share.system == SolvedSystem::strict)
            share.system = SolvedSystem::continued;
        share.reason = converged_in_words(share, "the forces of the tools had to be applied in steps",
                                          job.options.curve.trusted_strain, job.part.vertices());
    }
    report = std::move(share);
    if (report.process_share < 1)
        report.reason += fmt::format(
            "; with {:.2g} % of the forces of the tools: no step beyond that was solved; the sheet may not bear them, or the mesh be "
            "too coarse for how they would strain it",
            100 * report.process_share);
    return reached;
}

/// Pulled beyond its greatest force a sheet whose curve softens may hold the tools with strain gathered in a few rows of elements:
/// a solution that depends on the mesh. If more than one face in a hundred is beyond the uniform strain, the solution with the
/// continued curve, which is one only, is looked for from here; if it is another one, it is taken.
/// @param blank the strict solution
Eigen::Matrix2Xd without_necks(const Job& job, Eigen::Matrix2Xd blank, SolveReport& report, const Progress& progress)
{
    const StressCurve::Options hardening = hardening_on(job.options);
    const Sheet given = sheet_with(job, job.options.curve), sheet = sheet_with(job, hardening);
    const SheetFields face = face_fields(job.part, job.element, {blank}, given);
    const auto beyond = (face.strain_equivalent.array() > hardening.trusted_strain).count();
    if (100 * beyond <= job.part.triangles())
        return blank;
    VirtualWork work(job.part, job.element, sheet, job.external);
    EquilibriumOptions newton{job.options.most_newton_steps, job.options.tolerance, job.options.watch};
    newton.patient = false;
    EquilibriumResult result =
        solve_equilibrium(job.part, job.element, work, blank, job.matrix, job.cholesky, newton, progress);
    report.newton.insert(report.newton.end(), result.steps.begin(), result.steps.end());
    if (result.ended != Ended::converged || near_each_other(result.position, blank))
        return blank;
    report.residual = result.residual;
    report.resultant = result.resultant;
    report.system = SolvedSystem::continued;
    report.trusted_strain = sheet.law.front().curve().trusted_strain();
    report.reason = converged_in_words(report, "else the forces of the tools make it neck",
                                       job.options.curve.trusted_strain, job.part.vertices());
    return std::move(result.position);
}

} // namespace

Eigen::Matrix2Xd solve(const Job& job, const Eigen::Matrix2Xd& X, SolveReport& report, const Progress& progress)
{
    if (!job.external.any())
        return solve_at_once(job, X, report, progress);
    Eigen::Matrix2Xd blank = solve_at_once(job, X, report, progress.part(0, 0.6));
    if (report.system == SolvedSystem::strict)
        return without_necks(job, std::move(blank), report, progress.part(0.6, 1));
    if (report.system != SolvedSystem::energy)
        return blank;
    if (std::optional<Eigen::Matrix2Xd> stepped = in_steps(job, X, report, progress.part(0.6, 1)))
        return std::move(*stepped);
    report.process_share = 0;
    report.reason += "; the forces of the tools are not in it";
    return blank;
}

} // namespace spia
