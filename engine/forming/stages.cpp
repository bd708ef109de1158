#include "engine/forming/stages.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <optional>

#include "engine/forming/equilibrium.h"
#include "engine/forming/placing.h"
#include "engine/forming/stuck_places.h"

namespace spia {
namespace {

/// Largest logarithmic strain over the faces.
double largest_strain(const TriMesh& part, const std::vector<Element>& element, const Eigen::Matrix2Xd& X)
{
    double largest = 0;
    for (int f = 0; f < part.triangles(); ++f)
        largest = std::max(largest, svd(inverse_gradient(element[size_t(f)], corners(X, part.triangle.col(f))))
                                        .s.array()
                                        .log()
                                        .abs()
                                        .maxCoeff());
    return largest;
}

/// Newton decrements of the energy stage, relative: to try the equilibrium from, to go on from, as a start for the
/// equilibrium, as a result of its own.
constexpr double first_try = 0.1, rough = 1e-2, near_enough = 1e-3, exact = 1e-6;

/// Energy stage, from gentle to full growth of the continued hardening curve: exp(kappa eps) of a start with strains of 5
/// is no number to begin with.
EnergyResult energy_stage(const Job& job, const StressCurve::Options& curve, Eigen::Matrix2Xd X, double decrement,
                          int most_steps, SolveReport& report, const Progress& progress)
{
    std::vector<double> shares{1};
    if (largest_strain(job.part, job.element, X) > 2)
        shares = {0.25, 0.5, 1};
    EnergyResult result;
    for (size_t level = 0; level < shares.size(); ++level) {
        StressCurve::Options gentle = curve;
        gentle.continuation_rate *= shares[level];
        EnergyOptions energy;
        energy.most_steps = most_steps;
        energy.watch = job.options.watch;
        energy.decrement = level + 1 == shares.size() ? decrement : rough;
        result = minimise_energy(
            job.part.triangle, job.element, sheet_with(job, gentle), X, job.matrix, job.cholesky, energy,
            progress.part(double(level) / double(shares.size()), double(level + 1) / double(shares.size())));
        X = result.position;
        report.energy.insert(report.energy.end(), result.steps.begin(), result.steps.end());
    }
    return result;
}

void take(EquilibriumResult& equilibrium, SolveReport& report)
{
    report.newton.insert(report.newton.end(), equilibrium.steps.begin(), equilibrium.steps.end());
    report.residual = equilibrium.residual;
    report.resultant = equilibrium.resultant;
    report.converged = equilibrium.ended == Ended::converged;
}

/// The equations as they are, from a start X; none: they did not converge.
std::optional<Eigen::Matrix2Xd> strict_equilibrium(const Job& job, Eigen::Matrix2Xd X, const EquilibriumOptions& newton,
                                                   SolveReport& report, const Progress& progress)
{
    place_under_part(job.part, job.element, job.plane, X);
    const Sheet sheet = sheet_with(job, job.options.curve);
    VirtualWork work(job.part, job.element, sheet, job.external);
    EquilibriumResult result =
        solve_equilibrium(job.part, job.element, work, X, job.matrix, job.cholesky, newton, progress);
    take(result, report);
    if (!report.converged)
        return std::nullopt;
    report.reason = "converged";
    report.system = SolvedSystem::strict;
    return std::move(result.position);
}

/// A curve that never lets the sheet soften: its energy is convex enough to find the minimum from far away.
StressCurve::Options hardening_on(const FlattenOptions& options)
{
    StressCurve::Options hardening = options.curve;
    hardening.trusted_strain = uniform_strain(options.material.hardening, options.curve.trusted_strain);
    for (const TailoredPiece& piece : options.process.tailored)
        hardening.trusted_strain = uniform_strain(piece.material.hardening, hardening.trusted_strain);
    return hardening;
}

/// @param obstacle why the law as given had no solution
std::string converged_in_words(const SolveReport& report, const std::string& obstacle, double wanted_strain,
                               int vertices)
{
    std::string words = report.converged ? "converged" : "the virtual-work system was only solved in its relaxed form";
    if (report.trusted_strain < wanted_strain)
        words +=
            fmt::format(" with the hardening curve continued from the uniform strain {:.2f} on instead of {:.2f} ({})",
                        report.trusted_strain, wanted_strain, obstacle);
    if (report.relaxed_vertices > 0)
        words +=
            fmt::format("; equilibrium is relaxed at {} of {} vertices, where the mesh does not resolve how the strain "
                        "changes",
                        report.relaxed_vertices, vertices);
    return words;
}

} // namespace

Sheet sheet_with(const Job& job, const StressCurve::Options& curve)
{
    return sheet_of(job.options.material, job.options.thickness, curve, job.options.process, job.part, job.plane);
}

namespace {

/// All the forces at once.
Eigen::Matrix2Xd solve_at_once(const Job& job, Eigen::Matrix2Xd X, SolveReport& report, const Progress& progress)
{
    const FlattenOptions& options = job.options;
    const EquilibriumOptions newton{options.most_newton_steps, options.tolerance, options.watch};
    const StressCurve::Options hardening = hardening_on(options);
    report.trusted_strain = options.curve.trusted_strain;
    EquilibriumOptions quick = newton;
    quick.most_steps = std::min(20, newton.most_steps);
    quick.patient = false;
    X = energy_stage(job, hardening, std::move(X), first_try, options.most_energy_steps, report, progress.part(0, 0.2))
            .position;
    if (job.external.travelling.size() > 0) {
        Eigen::Matrix2Xd placed = X;
        place_under_part(job.part, job.element, job.plane, placed);
        job.external.stuck = stuck_places(job.part, job.element, job.external, placed);
    }
    if (std::optional<Eigen::Matrix2Xd> solved = strict_equilibrium(job, X, quick, report, progress.part(0.2, 0.4)))
        return std::move(*solved);

    X = energy_stage(job, hardening, std::move(X), rough, options.most_energy_steps, report, progress.part(0.4, 0.45))
            .position;
    const Eigen::Matrix2Xd hardened = X;
    constexpr int few_steps = 40; // more means that strain is gathering in single elements
    const EnergyResult energy =
        energy_stage(job, options.curve, X, near_enough, std::min(few_steps, options.most_energy_steps), report,
                     progress.part(0.45, 0.5));
    std::string obstacle = "the energy stage did not end";
    if (energy.ended == Ended::converged) {
        if (std::optional<Eigen::Matrix2Xd> solved =
                strict_equilibrium(job, energy.position, newton, report, progress.part(0.5, 0.6)))
            return std::move(*solved);
        obstacle = fmt::format("the equations stalled at a residual of {:.1e}", report.residual);
    }

    const Sheet sheet = sheet_with(job, hardening);
    report.trusted_strain = sheet.law.front().curve().trusted_strain();
    VirtualWork work(job.part, job.element, sheet, job.external);
    EnergyResult held{hardened};
    double from = 0.6;
    for (const double decrement : {near_enough, exact}) { // most often the first will do
        held = energy_stage(job, hardening, std::move(held.position), decrement, options.most_energy_steps, report,
                            progress.part(from, from + 0.05));
        place_under_part(job.part, job.element, job.plane, held.position);
        EquilibriumResult result =
            solve_relaxed_equilibrium(job.part, job.element, work, held.position, job.matrix, job.cholesky, newton,
                                      progress.part(from + 0.05, from + 0.2));
        take(result, report);
        from += 0.2;
        if (!report.converged)
            continue;
        report.relaxed_vertices = int(std::count(work.relaxed().begin(), work.relaxed().end(), char(1)));
        if (report.relaxed_vertices == 0) { // from here the curve as given may be near
            SolveReport again = report;
            again.trusted_strain = options.curve.trusted_strain;
            if (std::optional<Eigen::Matrix2Xd> solved =
                    strict_equilibrium(job, result.position, quick, again, progress.part(from, from))) {
                report = std::move(again);
                return std::move(*solved);
            }
            report.newton = std::move(again.newton);
        }
        report.converged = report.relaxed_vertices < job.part.vertices(); // else nothing is left of the system
        report.system = !report.converged             ? SolvedSystem::energy
                        : report.relaxed_vertices > 0 ? SolvedSystem::relaxed
                                                      : SolvedSystem::continued;
        report.reason = converged_in_words(report, obstacle, options.curve.trusted_strain, job.part.vertices());
        return std::move(result.position);
    }
    report.reason = fmt::format(
        "the virtual-work system was not solved (residual {:.1e} after {} steps); the blank is the one of least energy "
        "with the thickness held{}",
        report.residual, report.newton.size(), held.ended == Ended::converged ? "" : ", itself not fully converged");
    return std::move(held.position);
}

/// The forces from none on in steps, each from the blank of the one before, as far as equilibrium is found.
/// @param report  of all the forces at once, which had no solution; keeps its steps, and all else if there is none without
///                forces either
std::optional<Eigen::Matrix2Xd> solve_in_steps(const Job& job, const Eigen::Matrix2Xd& X, SolveReport& report,
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
            "; with {:.2g} % of the forces of the tools: beyond that no equilibrium was found, most likely because the sheet does not "
            "bear them. Lower the forces, or take a stronger sheet",
            100 * report.process_share);
    return reached;
}

} // namespace

Eigen::Matrix2Xd solve(const Job& job, Eigen::Matrix2Xd X, SolveReport& report, const Progress& progress)
{
    if (!job.external.any())
        return solve_at_once(job, std::move(X), report, progress);
    Eigen::Matrix2Xd blank = solve_at_once(job, X, report, progress.part(0, 0.6));
    if (report.system != SolvedSystem::energy)
        return blank;
    if (std::optional<Eigen::Matrix2Xd> in_steps = solve_in_steps(job, X, report, progress.part(0.6, 1)))
        return std::move(*in_steps);
    report.process_share = 0;
    report.reason += "; the forces of the tools are not in it";
    return blank;
}

} // namespace spia
