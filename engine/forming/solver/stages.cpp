#include "engine/forming/solver/stages.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <optional>

#include "engine/forming/solver/equilibrium.h"
#include "engine/forming/solver/placing.h"
#include "engine/forming/solver/stuck_places.h"
#include "engine/mesh/topology.h"

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

/// Newton decrements of the energy stage, relative: to try the equilibrium from, to go on from, as
/// a start for the equilibrium, as a result of its own.
constexpr double first_try = 0.1, rough = 1e-2, near_enough = 1e-3, exact = 1e-6;

/// Energy stage, from gentle to full growth of the continued hardening curve: exp(kappa eps) of a
/// start with strains of 5 is no number to begin with.
EnergyResult energy_stage(SolveContext& context, Curve curve, Eigen::Matrix2Xd X, double decrement, int most_steps,
                          SolveReport& report, const Progress& progress)
{
    std::vector<double> shares{1};
    if (largest_strain(context.part, context.element, X) > 2)
        shares = {0.25, 0.5, 1};
    EnergyResult result;
    for (size_t level = 0; level < shares.size(); ++level) {
        EnergyOptions energy;
        energy.most_steps = most_steps;
        energy.watch = context.watch;
        if (context.anchored)
            energy.held = context.external.held;
        energy.decrement = level + 1 == shares.size() ? decrement : rough;
        result = minimise_energy(
            context.part.triangle, context.element, sheet_with(context, curve, shares[level]), X, context.matrix,
            context.cholesky, energy,
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
std::optional<Eigen::Matrix2Xd> strict_equilibrium(SolveContext& context, Eigen::Matrix2Xd X,
                                                   const EquilibriumOptions& newton, SolveReport& report,
                                                   AttemptReport& own, const Progress& progress)
{
    place(context, X);
    const Sheet sheet = sheet_with(context, Curve::given);
    VirtualWork work(context.part, context.element, sheet, context.external);
    EquilibriumResult result =
        solve_equilibrium(context.part, context.element, work, X, context.matrix, context.cholesky, newton, progress);
    take(result, report);
    own.reason = describe(result);
    if (!report.converged)
        return std::nullopt;
    report.reason = "converged";
    report.system = SolvedSystem::strict;
    return std::move(result.position);
}

} // namespace

Sheet sheet_with(const SolveContext& context, Curve curve, double growth)
{
    const FlattenOptions& options = context.options;
    const auto from = [&](double strain) {
        StressCurve::Options how = options.curve;
        how.trusted_strain = strain;
        how.continuation_rate *= growth;
        return sheet_of(options.material, options.thickness, how, options.process, context.part, context.plane);
    };
    Sheet sheet = from(trusted_strain(context, curve, options.material.hardening));
    for (size_t piece = 0; piece < options.process.tailored.size(); ++piece) {
        const Hardening& own = options.process.tailored[piece].material.hardening;
        sheet.law[piece + 1] = from(trusted_strain(context, curve, own)).law[piece + 1];
    }
    return sheet;
}

double pull_of(const ExternalForces& external, const TriMesh& part, const FlattenOptions& options)
{
    double force = 0, around = 0;
    for (const Restraint& each : external.restraint)
        force += each.force;
    const Eigen::VectorXd area = area_vectors(part).colwise().norm();
    for (const Eigen::VectorXd* traction : {&external.traction, &external.travelling})
        if (traction->size() > 0)
            force += traction->dot(area);
    if (force == 0)
        return 0;
    const std::vector<int> outline = boundary_loops(part).front();
    for (size_t k = 0; k < outline.size(); ++k)
        around += (part.position.col(outline[(k + 1) % outline.size()]) - part.position.col(outline[k])).norm();
    return force / (around * lock_force(options.material, options.thickness));
}

double trusted_strain(const SolveContext& context, Curve curve, const Hardening& grade)
{
    constexpr double much = 0.1; // square cup: from a pull of 0.3 on strain would gather in rows
    const double given = context.options.curve.trusted_strain, uniform = uniform_strain(grade, given);
    return curve == Curve::continued ? uniform : uniform + (given - uniform) * std::exp(-context.pull / much);
}

void place(const SolveContext& context, Eigen::Matrix2Xd& X)
{
    if (context.anchored)
        return;
    place_under_part(context.part, context.element, context.plane, X);
    if (!context.external.held.empty())
        place_on(context.external.held, X);
}

Sheet solved_sheet(const SolveContext& context, const SolveReport& report)
{
    const bool as_given =
        report.trusted_strain == trusted_strain(context, Curve::given, context.options.material.hardening);
    return sheet_with(context, as_given ? Curve::given : Curve::continued);
}

std::string describe_convergence(const SolveReport& report, const std::string& obstacle, double wanted_strain,
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

namespace {

/// Whether two blanks differ by a hundredth of their size at most. The curve as given lets the
/// sheet soften: far from the blank of the continued one its equations may have another solution,
/// in which strain gathers in a few rows of elements.
bool near_each_other(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b)
{
    constexpr double near = 0.01;
    return (a - b).colwise().norm().maxCoeff() <= near * (b.rowwise().maxCoeff() - b.rowwise().minCoeff()).norm();
}

EquilibriumOptions newton_of(const SolveContext& context)
{
    return {context.options.most_newton_steps, context.options.tolerance, context.watch};
}

EquilibriumOptions quick(EquilibriumOptions newton)
{
    newton.most_steps = std::min(20, newton.most_steps);
    newton.allow_lu = false;
    return newton;
}

/// With the curve as asked for, after its own energy stage and with a sparse LU in reserve.
/// @param obstacle why there is none
std::optional<Eigen::Matrix2Xd> as_asked_for(SolveContext& context, const Eigen::Matrix2Xd& X, SolveReport& report,
                                             std::string& obstacle, AttemptReport& own, const Progress& progress)
{
    constexpr int few_steps = 40; // more means that strain is gathering in single elements
    const EnergyResult energy =
        energy_stage(context, Curve::given, X, near_enough, std::min(few_steps, context.options.most_energy_steps),
                     report, progress.part(0, 0.3));
    obstacle = own.reason = "the energy stage did not end";
    if (energy.ended != Ended::converged)
        return std::nullopt;
    std::optional<Eigen::Matrix2Xd> solved =
        strict_equilibrium(context, energy.position, newton_of(context), report, own, progress.part(0.3, 1));
    obstacle = fmt::format("the equations stalled at a residual of {:.1e}", report.residual);
    return solved;
}

/// With the curve continued from the uniform strain on, equations relaxed where they have to be; at
/// last the blank of the energy stage.
class ContinuedSolve {
public:
    /// @param X  roughly that of the energy stage
    /// @param obstacle  why the curve as given was not kept
    ContinuedSolve(SolveContext& context, Eigen::Matrix2Xd X, SolveReport& report, const std::string& obstacle)
        : context_(context), sheet_(sheet_with(context, Curve::continued)),
          work_(context.part, context.element, sheet_, context.external), report_(report),
          obstacle_(obstacle), energy_{std::move(X)}
    {
        report_.trusted_strain = trusted_strain(context, Curve::continued, context.options.material.hardening);
    }

    Eigen::Matrix2Xd solve(AttemptReport& own, const Progress& progress)
    {
        const auto from_near = [&](AttemptReport& here) { // most often that will do
            return from_energy(near_enough, here, progress.part(0, 0.5));
        };
        const auto from_exact = [&](AttemptReport& here) { return from_energy(exact, here, progress.part(0.5, 1)); };
        own.within = try_in_order({{"equilibrium from near the least energy", {}, from_near},
                                   {"equilibrium from the least energy", {}, from_exact},
                                   {"least energy", {}, [&](AttemptReport& here) { return take_energy(here); }}});
        return std::move(*solved_);
    }

private:
    bool from_energy(double decrement, AttemptReport& own, const Progress& progress)
    {
        energy_ = energy_stage(context_, Curve::continued, std::move(energy_.position), decrement,
                               context_.options.most_energy_steps, report_, progress.part(0, 0.24));
        place(context_, energy_.position);
        const auto continued = [&](AttemptReport& here) { return relaxed(here, progress.part(0.24, 1)); };
        const auto given = [&](AttemptReport& here) { return as_given(here, progress.part(1, 1)); };
        own.within =
            try_in_order({{"hardening curve continued", {}, continued, [&] { return report_.relaxed_vertices > 0; }},
                          {"hardening curve as given, from there", [&] { return solved_.has_value(); }, given}});
        return solved_.has_value();
    }

    bool relaxed(AttemptReport& own, const Progress& progress)
    {
        const int vertices = context_.part.vertices();
        EquilibriumResult result =
            solve_relaxed_equilibrium(context_.part, context_.element, work_, energy_.position, context_.matrix,
                                      context_.cholesky, newton_of(context_), progress);
        take(result, report_);
        own.within = std::move(result.attempts);
        own.reason = describe(result);
        if (!report_.converged)
            return false;
        report_.relaxed_vertices = int(std::count(work_.relaxed().begin(), work_.relaxed().end(), char(1)));
        // else nothing is left of the system
        report_.converged = report_.relaxed_vertices < vertices;
        report_.system = !report_.converged             ? SolvedSystem::energy
                         : report_.relaxed_vertices > 0 ? SolvedSystem::relaxed
                                                        : SolvedSystem::continued;
        report_.reason = describe_convergence(report_, obstacle_, context_.options.curve.trusted_strain, vertices);
        solved_ = std::move(result.position);
        return true;
    }

    /// With no vertex relaxed the curve as given may be near.
    bool as_given(AttemptReport& own, const Progress& progress)
    {
        SolveReport again = report_;
        again.trusted_strain = trusted_strain(context_, Curve::given, context_.options.material.hardening);
        std::optional<Eigen::Matrix2Xd> given =
            strict_equilibrium(context_, *solved_, quick(newton_of(context_)), again, own, progress);
        if (given && near_each_other(*given, *solved_)) {
            report_ = std::move(again);
            solved_ = std::move(given);
            return true;
        }
        if (given)
            own.reason = "converged to another blank";
        report_.newton = std::move(again.newton);
        return false;
    }

    bool take_energy(AttemptReport& own)
    {
        const bool converged = energy_.ended == Ended::converged;
        report_.reason = fmt::format(
            "the virtual-work system was not solved (residual {:.1e} after {} steps); the blank is the one of least energy "
            "with the thickness held{}",
            report_.residual, report_.newton.size(), converged ? "" : ", itself not fully converged");
        own.reason = converged ? "converged" : "not fully converged";
        solved_ = std::move(energy_.position);
        return true;
    }

    SolveContext& context_;
    Sheet sheet_;
    VirtualWork work_;
    SolveReport& report_;
    const std::string& obstacle_;
    EnergyResult energy_;
    std::optional<Eigen::Matrix2Xd> solved_;
};

} // namespace

Eigen::Matrix2Xd solve_at_once(SolveContext& context, Eigen::Matrix2Xd X, SolveReport& report, const Progress& progress)
{
    const FlattenOptions& options = context.options;
    report.trusted_strain = trusted_strain(context, Curve::given, options.material.hardening);
    std::optional<Eigen::Matrix2Xd> solved;
    std::string obstacle;
    const auto at_once = [&](AttemptReport& own) {
        X = energy_stage(context, Curve::continued, std::move(X), first_try, options.most_energy_steps, report,
                         progress.part(0, 0.2))
                .position;
        if (context.external.travelling.size() > 0) {
            Eigen::Matrix2Xd placed = X;
            place(context, placed);
            context.external.stuck = stuck_places(context.part, context.element, context.external, placed);
        }
        solved = strict_equilibrium(context, X, quick(newton_of(context)), report, own, progress.part(0.2, 0.4));
        return solved.has_value();
    };
    const auto from_its_energy = [&](AttemptReport& own) {
        X = energy_stage(context, Curve::continued, std::move(X), rough, options.most_energy_steps, report,
                         progress.part(0.4, 0.45))
                .position;
        solved = as_asked_for(context, X, report, obstacle, own, progress.part(0.45, 0.6));
        return solved.has_value();
    };
    const auto continued = [&](AttemptReport& own) {
        solved = ContinuedSolve(context, std::move(X), report, obstacle).solve(own, progress.part(0.6, 1));
        return true;
    };
    report.attempts = try_in_order({{"hardening curve as given", {}, at_once},
                                    {"hardening curve as given, from its own energy stage", {}, from_its_energy},
                                    {"hardening curve continued from the uniform strain", {}, continued}});
    return std::move(*solved);
}

} // namespace spia
