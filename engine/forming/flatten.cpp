#include "engine/forming/flatten.h"

#include <Eigen/Dense>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/forming/equilibrium.h"
#include "engine/forming/sheet_fields.h"
#include "engine/mesh/cut.h"
#include "engine/mesh/topology.h"

namespace spia {
namespace {

void require_valid(const TriMesh& part, const FlattenOptions& options)
{
    if (part.triangles() == 0)
        throw InputError("the part has no faces");
    if (!(options.thickness > 0) || !std::isfinite(options.thickness))
        throw InputError(fmt::format("the sheet thickness is {} mm; it must be positive", options.thickness));
    if (options.direction && !(options.direction->norm() > 0 && options.direction->allFinite()))
        throw InputError("the stamping direction must be a finite vector that is not zero");
    const SurfaceType type = surface_type(part);
    if (type.loops == 0)
        throw InputError("the part is closed: it has no edge from which it could be unfolded; cut it open");
    if (type.components > 1)
        throw InputError(fmt::format("the part is {} separate pieces; unfold them one by one", type.components));
    if (type.genus > 0)
        throw InputError(fmt::format("the part has {} (genus {}); cut it open",
                                     type.genus == 1 ? "a handle" : "handles", type.genus));
}

StampingDirection stamping(const TriMesh& part, const FlattenOptions& options)
{
    if (!options.direction)
        return stamping_direction(part);
    StampingDirection given{options.direction->normalized(), 0, true, 0};
    double hidden = 0, area = 0;
    const Eigen::Matrix3Xd area_vector = area_vectors(part);
    for (int f = 0; f < part.triangles(); ++f) {
        const double size = area_vector.col(f).norm(), cosine = area_vector.col(f).dot(given.direction) / size;
        given.steepest_angle = std::max(given.steepest_angle, std::acos(std::clamp(cosine, -1.0, 1.0)));
        hidden += cosine <= 0 ? size : 0;
        area += size;
    }
    given.height_field = hidden == 0;
    given.hidden_area_fraction = hidden / area;
    return given;
}

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

/// Turns and moves the blank so that it lies, area by area, as near as it can under the part seen along the stamping
/// direction. [Kabsch 1976 in the plane]
void place_under_part(const TriMesh& part, const std::vector<Element>& element,
                      const Eigen::Matrix<double, 3, 2>& plane, Eigen::Matrix2Xd& X)
{
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(part.vertices());
    for (int f = 0; f < part.triangles(); ++f)
        for (int a = 0; a < 3; ++a)
            mass[part.triangle(a, f)] += element[size_t(f)].area / 3;
    mass /= mass.sum();
    const Eigen::Matrix2Xd below = plane.transpose() * part.position;
    const Eigen::Vector2d to = below * mass, from = X * mass;
    const Eigen::Matrix2d moment = (below.colwise() - to) * mass.asDiagonal() * (X.colwise() - from).transpose();
    const double angle = std::atan2(moment(1, 0) - moment(0, 1), moment(0, 0) + moment(1, 1));
    X = (Eigen::Rotation2Dd(angle).toRotationMatrix() * (X.colwise() - from)).colwise() + to;
}

/// Axes of the blank in space: x as near to the part's own x axis as the plane allows.
Eigen::Matrix<double, 3, 2> blank_plane(const Eigen::Vector3d& direction)
{
    Eigen::Vector3d x = Eigen::Vector3d::UnitX() - direction[0] * direction;
    if (x.norm() < 0.1)
        x = Eigen::Vector3d::UnitY() - direction[1] * direction;
    Eigen::Matrix<double, 3, 2> plane;
    plane.col(0) = x.normalized();
    plane.col(1) = direction.cross(plane.col(0));
    return plane;
}

/// The process on a part that was moved.
ProcessConditions moved(ProcessConditions process, const Eigen::Vector3d& by)
{
    for (Drawbead& bead : process.drawbeads)
        for (Eigen::Vector3d& point : bead.line)
            point += by;
    for (Pilot& pilot : process.pilots)
        for (Eigen::Vector3d& point : pilot.line)
            point += by;
    return process;
}

/// Where the blank lies before forming: on the binder if there is one, else where the part's outer edge is.
double blank_height(const ProcessConditions& process, const TriMesh& part, const Eigen::Vector3d& direction)
{
    double sum = 0, count = 0;
    const auto take = [&](int v) {
        sum += part.position.col(v).dot(direction);
        ++count;
    };
    for (const ContactRegion& region : process.contact)
        if (region.sides == 2)
            for (const int f : region.faces)
                for (int a = 0; a < 3 && f >= 0 && f < part.triangles(); ++a)
                    take(part.triangle(a, f));
    if (count == 0) {
        const std::vector<std::vector<int>> loops = boundary_loops(part);
        std::for_each(loops.front().begin(), loops.front().end(), take);
    }
    return sum / count;
}

/// What every stage of one solution needs.
struct Job {
    const TriMesh& part;
    const std::vector<Element>& element;
    const FlattenOptions& options;
    const ExternalForces& external;
    const Eigen::Matrix<double, 3, 2>& plane; ///< axes of the blank in space
    BlockMatrix& matrix;
    Cholesky& cholesky;
};

Sheet sheet_with(const Job& job, const StressCurve::Options& curve)
{
    return sheet_of(job.options.material, job.options.thickness, curve, job.options.process, job.part, job.plane);
}

/// Newton decrements of the energy stage, relative: to go on from, as a start for the equilibrium, as a result of its own.
constexpr double rough = 1e-2, near_enough = 1e-3, exact = 1e-6;

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

/// The three stages from a flip-free start X to the blank, each tried where the one before did not get there.
Eigen::Matrix2Xd solve(const Job& job, Eigen::Matrix2Xd X, SolveReport& report, const Progress& progress)
{
    const FlattenOptions& options = job.options;
    const EquilibriumOptions newton{options.most_newton_steps, options.tolerance, options.watch};
    // A curve that never lets the sheet soften: its energy is convex enough to find the minimum from far away.
    StressCurve::Options hardening = options.curve;
    hardening.trusted_strain = uniform_strain(options.material.hardening, options.curve.trusted_strain);
    for (const TailoredPiece& piece : options.process.tailored)
        hardening.trusted_strain = uniform_strain(piece.material.hardening, hardening.trusted_strain);
    X = energy_stage(job, hardening, std::move(X), rough, options.most_energy_steps, report, progress.part(0, 0.3))
            .position;
    place_under_part(job.part, job.element, job.plane, X);
    const Eigen::Matrix2Xd hardened = X;

    report.trusted_strain = options.curve.trusted_strain;
    constexpr int few_steps = 40; // more means that strain is gathering in single elements
    const EnergyResult energy =
        energy_stage(job, options.curve, X, near_enough, std::min(few_steps, options.most_energy_steps), report,
                     progress.part(0.3, 0.4));
    std::string obstacle = "the energy stage did not end";
    if (energy.ended == Ended::converged) {
        const Sheet sheet = sheet_with(job, options.curve);
        VirtualWork work(job.part, job.element, sheet, job.external);
        EquilibriumResult result = solve_equilibrium(job.part, job.element, work, energy.position, job.matrix,
                                                     job.cholesky, newton, progress.part(0.4, 0.6));
        take(result, report);
        if (report.converged) {
            report.reason = "converged";
            report.system = SolvedSystem::strict;
            return std::move(result.position);
        }
        obstacle = fmt::format("the equations stalled at a residual of {:.1e}", result.residual);
    }

    const Sheet sheet = sheet_with(job, hardening);
    report.trusted_strain = sheet.law.front().curve().trusted_strain();
    VirtualWork work(job.part, job.element, sheet, job.external);
    EnergyResult held{hardened};
    double from = 0.6;
    for (const double decrement : {near_enough, exact}) { // most often the first will do
        held = energy_stage(job, hardening, std::move(held.position), decrement, options.most_energy_steps, report,
                            progress.part(from, from + 0.05));
        EquilibriumResult result =
            solve_relaxed_equilibrium(job.part, job.element, work, held.position, job.matrix, job.cholesky, newton,
                                      progress.part(from + 0.05, from + 0.2));
        take(result, report);
        from += 0.2;
        if (!report.converged)
            continue;
        report.relaxed_vertices = int(std::count(work.relaxed().begin(), work.relaxed().end(), char(1)));
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

/// Incompressibility, from thickness and areas measured anew in space and in the plane.
double volume_error(const TriMesh& part, const FlattenResult& result, const Sheet& sheet)
{
    const Eigen::VectorXd formed = area_vectors(part).colwise().norm();
    double largest = 0;
    for (int f = 0; f < part.triangles(); ++f) {
        const auto x = corners(result.blank.position, part.triangle.col(f));
        const Eigen::Vector2d p = x.col(1) - x.col(0), q = x.col(2) - x.col(0);
        const double flat = 0.5 * (p[0] * q[1] - p[1] * q[0]);
        const double h0 = sheet.thickness[f];
        largest = std::max(largest, std::abs(result.face.thickness[f] * formed[f] - h0 * flat) / (h0 * flat));
    }
    return largest;
}

} // namespace

std::string_view name(SolvedSystem system)
{
    switch (system) {
    case SolvedSystem::strict: return "strict";
    case SolvedSystem::continued: return "continued";
    case SolvedSystem::relaxed: return "relaxed";
    case SolvedSystem::energy: return "energy";
    }
    return "";
}

FlattenResult flatten(const TriMesh& original, const FlattenOptions& options, const Progress& progress)
{
    const auto clock = std::chrono::steady_clock::now();
    require_valid(original, options);
    // Far from the origin (a part in car coordinates) the digits of a blank would not do for equilibrium to 1e-9.
    TriMesh part = original;
    const Eigen::Vector3d centre = (part.position.rowwise().minCoeff() + part.position.rowwise().maxCoeff()) / 2;
    part.position.colwise() -= centre;
    const std::vector<Element> element = elements(part);
    FlattenResult result;
    result.stamping = stamping(part, options);
    const Eigen::Matrix<double, 3, 2> plane = blank_plane(result.stamping.direction);

    const ExternalForces external =
        external_forces(moved(options.process, -centre), part, options.material, options.thickness, plane,
                        result.stamping.direction * blank_height(options.process, part, result.stamping.direction));

    progress.checkpoint(0, "ordering the equations");
    BlockMatrix matrix(part.triangle, part.vertices());
    Cholesky cholesky(matrix);
    InitialGuess guess = initial_guess(part, element, result.stamping, matrix, cholesky, progress.part(0.03, 0.1));
    result.report.start = guess.method;

    const Job job{part, element, options, external, plane, matrix, cholesky};
    result.blank.position = solve(job, std::move(guess.position), result.report, progress.part(0.1, 1));
    if (result.report.system == SolvedSystem::energy) // the others lie there
        place_under_part(part, element, plane, result.blank.position);

    StressCurve::Options curve = options.curve;
    curve.trusted_strain = result.report.trusted_strain;
    const Sheet sheet = sheet_with(job, curve);
    result.face = face_fields(part, element, result.blank, sheet);
    result.node = node_fields(part, element, result.face);
    result.necking_triangles = result.face.necking.sum();
    result.volume_error = volume_error(part, result, sheet);
    result.blank.position.colwise() += plane.transpose() * centre;
    result.flipped_triangles = flipped_triangles(part.triangle, result.blank.position);
    if (result.flipped_triangles > 0)
        throw SolveError(
            fmt::format("{} triangles of the blank are too thin for coordinates {:.3g} mm from the origin: move "
                        "the part nearer to it, or mesh it more evenly",
                        result.flipped_triangles, centre.norm()));
    result.overlap = overlap(part, result.blank.position);
    result.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    return result;
}

} // namespace spia
