#include "engine/forming/flatten.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/error.h"
#include "engine/forming/flatten_from.h"
#include "engine/forming/solver/load_steps.h"
#include "engine/forming/solver/placing.h"
#include "engine/forming/solver/rigid_steps.h"
#include "engine/forming/solver/seen_along.h"
#include "engine/forming/solver/sheet_fields.h"
#include "engine/forming/solver/volume_error.h"
#include "engine/mesh/cut/cut.h"
#include "engine/mesh/orient2d.h"
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

void require_start(const TriMesh& part, const Eigen::Matrix2Xd& start)
{
    if (start.cols() != part.vertices() || !start.allFinite())
        throw InputError(
            fmt::format("the start has {} places, the part {} vertices; it must have a finite place for each",
                        start.cols(), part.vertices()));
    for (int f = 0; f < part.triangles(); ++f) {
        const auto t = part.triangle.col(f);
        if (orient2d(start.col(t[0]), start.col(t[1]), start.col(t[2])) <= 0)
            throw InputError(fmt::format("face {} is flipped in the start; give one without flips", f));
    }
    if (!one_to_one_around_vertices(part, start))
        throw InputError("the faces around a vertex of the start go around it more than once; give another start");
}

StampingDirection stamping(const TriMesh& part, const FlattenOptions& options)
{
    return options.direction ? seen_along(part, *options.direction) : stamping_direction(part);
}

/// The first guess, as rigid as possible.
Eigen::Matrix2Xd first_guess(const TriMesh& part, const std::vector<Element>& element, BlockMatrix& matrix,
                             Cholesky& cholesky, const Progress& progress, FlattenResult& result)
{
    InitialGuess guess = initial_guess(part, element, result.stamping, matrix, cholesky, progress.part(0.03, 0.1));
    result.report.start = guess.method;
    progress.checkpoint(0.08, "first guess: as rigid as possible");
    return more_rigid(part, RigidSteps(part, element, matrix, cholesky), std::move(guess.position),
                      progress.part(0.08, 0.1));
}

/// @param start none: a first guess of its own
FlattenResult flatten_part(const TriMesh& original, const Eigen::Matrix2Xd* start, const LaidLengths& laid,
                           const FlattenOptions& options, const Progress& progress, const StepWatch& watch)
{
    const auto clock = std::chrono::steady_clock::now();
    require_valid(original, options);
    if (start)
        require_start(original, *start);
    // Far from the origin (a part in car coordinates) the digits of a blank would not do for
    // equilibrium to 1e-9.
    TriMesh part = original;
    const Eigen::Vector3d centre = (part.position.rowwise().minCoeff() + part.position.rowwise().maxCoeff()) / 2;
    part.position.colwise() -= centre;
    progress.checkpoint(0, "looking for the stamping direction");
    const std::vector<Element> element = elements(part, laid);
    FlattenResult result{};
    result.stamping = stamping(part, options);
    const Eigen::Matrix<double, 3, 2> plane = blank_plane(result.stamping.direction);

    ExternalForces external =
        external_forces(options.process, original, options.material, options.thickness, plane, centre);

    progress.checkpoint(0, "ordering the equations");
    BlockMatrix matrix(part.triangle, part.vertices());
    Cholesky cholesky(matrix);
    const Eigen::Matrix2Xd X = start ? Eigen::Matrix2Xd(start->colwise() - start->rowwise().mean())
                                     : first_guess(part, element, matrix, cholesky, progress, result);

    const double pull = pull_of(external, part, options);
    SolveContext context{part,  element, options, std::move(external), plane, std::move(matrix), std::move(cholesky),
                         false, pull,    watch};
    result.blank.position = solve(context, X, result.report, progress.part(0.1, 1));
    if (result.report.system == SolvedSystem::energy) // the others lie there
        place(context, result.blank.position);

    const auto judging = [&] { progress.checkpoint(1, "strains and thickness"); };
    judging();
    const Sheet sheet = solved_sheet(context, result.report);
    result.face = face_fields(part, element, result.blank, sheet);
    result.node = node_fields(part, element, result.face);
    judging();
    if (options.skins)
        result.skins = skin_strains(part, element, result.blank, sheet);
    result.necking_triangles = result.face.necking.sum();
    result.volume_error = volume_error(part, result.blank, result.face, sheet.thickness, laid);
    result.blank.position.colwise() += plane.transpose() * centre;
    result.flipped_triangles = flipped_triangles(part.triangle, result.blank.position);
    if (result.flipped_triangles > 0)
        throw SolveError(
            fmt::format("{} triangles of the blank are too thin for coordinates {:.3g} mm from the origin: move "
                        "the part nearer to it, or mesh it more evenly",
                        result.flipped_triangles, centre.norm()));
    judging();
    result.overlap = overlap(part, result.blank.position);
    result.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    return result;
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

bool formed_alike(const FlattenOptions& a, const FlattenOptions& b)
{
    FlattenOptions of_the_same_grade = a;
    of_the_same_grade.material = b.material;
    return formed_alike(a.material, b.material) && of_the_same_grade == b;
}

FlattenResult flatten(const TriMesh& part, const FlattenOptions& options, const Progress& progress,
                      const StepWatch& watch)
{
    return flatten_part(part, nullptr, {}, options, progress, watch);
}

FlattenResult flatten_from(const TriMesh& part, const Eigen::Matrix2Xd& start, const FlattenOptions& options,
                           const Progress& progress, const StepWatch& watch)
{
    return flatten_part(part, &start, {}, options, progress, watch);
}

FlattenResult flatten_laid(const TriMesh& part, const LaidLengths& laid, const Eigen::Matrix2Xd* start,
                           const FlattenOptions& options, const Progress& progress, const StepWatch& watch)
{
    return flatten_part(part, start, laid, options, progress, watch);
}

} // namespace spia
