#include "engine/unfold/step/solve_piece.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/core.h>
#include <functional>
#include <optional>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/forming/flatten_from.h"
#include "engine/forming/solver/equilibrium.h"
#include "engine/forming/solver/load_steps.h"
#include "engine/forming/solver/placing.h"
#include "engine/forming/solver/sheet_fields.h"
#include "engine/unfold/step/piece_picture.h"
#include "engine/unfold/step/piece_start.h"
#include "engine/unfold/step/ring_start.h"
#include "engine/unfold/step/target_friction.h"

namespace spia {
namespace {

/// The options as they are for the faces of the piece alone.
FlattenOptions options_of(const FreedPiece& piece, FlattenOptions options)
{
    std::vector<TailoredPiece> tailored;
    for (TailoredPiece& t : options.process.tailored) {
        std::vector<int> local;
        for (const int f : t.faces)
            if (const auto at = std::lower_bound(piece.face.begin(), piece.face.end(), f);
                at != piece.face.end() && *at == f)
                local.push_back(int(at - piece.face.begin()));
        t.faces = std::move(local);
        if (!t.faces.empty())
            tailored.push_back(std::move(t));
    }
    options.process.tailored = std::move(tailored);
    options.direction.reset();
    options.skins = false;
    return options;
}

/// As steps before have left it, if that is seen whole along the normal: a start that flatten() may
/// not find from the part.
std::optional<Eigen::Matrix2Xd> seen_start(const FreedPiece& piece, const Eigen::Matrix3Xd& now,
                                           const Eigen::Vector3d& normal)
{
    if (now == piece.mesh.position)
        return std::nullopt;
    Eigen::Matrix2Xd seen = blank_plane(normal).transpose() * now;
    if (flipped_triangles(piece.mesh.triangle, seen) > 0 || !one_to_one_around_vertices(piece.mesh, seen))
        return std::nullopt;
    return seen;
}

/// Joined to nothing it lies anywhere: as flatten() lays it.
SolvedPiece free_piece(const FreedPiece& piece, const Eigen::Matrix3Xd& now, const TargetSurface& target,
                       const FlattenOptions& options, const Progress& progress)
{
    const auto* plane = std::get_if<PlaneFace>(&target);
    if (!plane)
        throw InputError(
            fmt::format("the freed faces around face {} are joined to no fixed face; then only a plane can "
                        "be their target, not a {}",
                        piece.face[0], name(target)));
    FlattenOptions seen = options;
    const Eigen::Vector3d normal = plane->axes.col(0).cross(plane->axes.col(1));
    seen.direction = normal;
    const std::optional<Eigen::Matrix2Xd> start = seen_start(piece, now, normal);
    FlattenResult flat;
    const auto from_seen = [&](AttemptReport&) {
        flat = flatten_from(piece.mesh, *start, seen, progress);
        return true;
    };
    const auto anew = [&](AttemptReport&) {
        flat = flatten(piece.mesh, seen, progress);
        return true;
    };
    // Steps may leave a state from which there is no way on.
    const std::vector<AttemptReport> made =
        try_in_order({{"from where it is seen", [&] { return start.has_value(); }, from_seen, {}, true},
                      {"from a start of its own", {}, anew}});
    if (made.front().refusal)
        flat.report.attempts.insert(flat.report.attempts.begin(), made.front());
    const Eigen::Vector3d height = normal * normal.dot(plane->origin);
    return {(blank_plane(flat.stamping.direction) * flat.blank.position).colwise() + height, std::move(flat.face),
            std::move(flat.report)};
}

/// The axes of the development in space, where the hinge is; of a smooth face those of its plane.
Eigen::Matrix<double, 3, 2> axes_at(const TargetSurface& target, const Eigen::Vector2d& place)
{
    if (const auto* height = std::get_if<HeightFace>(&target))
        return height->axes;
    if (std::holds_alternative<ConeFace>(target)) // its axes turn beside its middle
        return tangents(target, {0, place.norm()});
    return tangents(target, place);
}

/// Friction of the piece's own faces; none where nothing rubs on them.
Eigen::VectorXd of_piece(const Eigen::VectorXd& traction, const FreedPiece& piece)
{
    const bool rubs = traction.size() > 0 && traction(piece.face).maxCoeff() > 0;
    return rubs ? Eigen::VectorXd(traction(piece.face)) : Eigen::VectorXd();
}

/// That as flatten() takes it, which knows the part alone.
std::vector<ContactRegion> rubbing(const FreedPiece& piece, const Eigen::Matrix3Xd& now,
                                   const Eigen::VectorXd& traction)
{
    if (traction.size() == 0)
        return {};
    if (now != piece.mesh.position)
        throw InputError(
            fmt::format("the freed faces around face {} are joined to no fixed face and not as they are in the part: "
                        "the friction on them cannot be determined; leave out the friction, or fix some",
                        piece.face[0]));
    // both sides together: the traction itself
    ContactRegion region{"the target", {}, traction.maxCoeff(), {}, 0.5, 2};
    for (int f = 0; f < piece.mesh.triangles(); ++f)
        if (traction[f] > 0)
            region.faces.push_back(f);
    return {region};
}

/// A cone ends in its apex: behind it, along the negative y axis, its development is cut.
void require_beside_apex(const FreedPiece& piece, const TargetSurface& target, const Eigen::Matrix2Xd& X)
{
    if (!std::holds_alternative<ConeFace>(target))
        return;
    for (int f = 0; f < piece.mesh.triangles(); ++f) {
        const auto x = corners(X, piece.mesh.triangle.col(f));
        for (int a = 0; a < 3; ++a) {
            const Eigen::Vector2d p = x.col(a), q = x.col((a + 1) % 3);
            if ((p[0] > 0) != (q[0] > 0) && (p[1] * q[0] - q[1] * p[0]) / (q[0] - p[0]) <= 0)
                throw SolveError(fmt::format("face {} would come to lie across the apex of the cone or behind it; free "
                                             "fewer faces, or give another target",
                                             piece.face[size_t(f)]));
        }
    }
}

/// @returns the face of the part, or -1
int first_flipped(const FreedPiece& piece, const PiecePicture& picture, const Eigen::Matrix2Xd& X)
{
    const Eigen::Vector3i alone(0, 1, 2);
    for (int f = 0; f < piece.mesh.triangles(); ++f) {
        const auto corner = corners(X, piece.mesh.triangle.col(f));
        if (flipped_triangles(alone, corner) > 0 ||
            (picture.ring && flipped_triangles(alone, picture.ring->developed(corner)) > 0))
            return piece.face[size_t(f)];
    }
    return -1;
}

/// The lengths of the target around the middle of each triangle.
void take_lengths(const FreedPiece& piece, const PiecePicture& picture, const Eigen::Matrix2Xd& X,
                  const Eigen::Vector2d& middle, std::vector<Element>& element)
{
    if (picture.true_lengths())
        return;
    parallel_for(piece.mesh.triangles(), [&](int f) {
        element[size_t(f)].metric = picture.lengths(corners(X, piece.mesh.triangle.col(f)).colwise() + middle);
    });
}

/// Solves anew with the lengths where the piece has come to lie, until it lies where they were
/// taken.
/// @param X the solution with other lengths
/// @param face what it lies on, in words
Eigen::Matrix2Xd in_rounds(SolveContext& context, const std::function<void(const Eigen::Matrix2Xd&)>& measure,
                           Eigen::Matrix2Xd X, std::string_view face, SolveReport& report, const Progress& progress)
{
    constexpr int most_rounds = 30;
    constexpr double still = 1e-8; // of the piece
    const double size = (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).norm();
    const Sheet sheet = solved_sheet(context, report);
    double way = 0;
    for (int round = 0; round < most_rounds && report.converged; ++round) {
        const Progress mine = progress.part(double(round) / most_rounds, double(round + 1) / most_rounds);
        measure(X);
        Eigen::Matrix2Xd next;
        if (report.relaxed_vertices == 0) {
            VirtualWork work(context.part, context.element, sheet, context.external);
            const EquilibriumOptions newton{context.options.most_newton_steps, context.options.tolerance, {}};
            EquilibriumResult solved = solve_equilibrium(context.part, context.element, work, X, context.matrix,
                                                         context.cholesky, newton, mine);
            report.newton.insert(report.newton.end(), solved.steps.begin(), solved.steps.end());
            report.residual = solved.residual;
            report.converged = solved.ended == Ended::converged;
            next = std::move(solved.position);
        } else {
            // of the forces: of it the context has all by now
            const double share = std::exchange(report.process_share, 1);
            next = solve(context, X, report, mine);
            report.process_share *= share;
            add_share(report);
        }
        way = (next - X).colwise().norm().maxCoeff();
        X = std::move(next);
        if (report.converged && way <= still * size)
            return X;
    }
    report.reason =
        report.converged
            ? fmt::format("the piece still moves by {:.1e} mm from round to round on the {}", way, face)
            : fmt::format("the equations were solved on the {} with lengths from nearby, not with its own; ", face) +
                  report.reason;
    report.converged = false;
    return X;
}

PieceStart start_of(const TriMesh& part, const Eigen::Matrix3Xd& state, const std::vector<int>& fixed,
                    const FreedPiece& piece, const PiecePicture& picture, SolveContext& context,
                    const std::function<void(const Eigen::Matrix2Xd&)>& measure, const Progress& progress)
{
    if (picture.ring) {
        Eigen::Matrix2Xd X = ring_start(piece, state(Eigen::all, piece.vertex), *picture.ring);
        if (one_to_one_around_vertices(piece.mesh, X))
            return {std::move(X), StartMethod::harmonic};
    }
    return piece_start(part, state, fixed, piece, context, measure, progress);
}

} // namespace

SolvedPiece solve_piece(const TriMesh& part, const Eigen::Matrix3Xd& state, const std::vector<int>& fixed,
                        const FreedPiece& piece, const TargetSurface& given_target, const Eigen::VectorXd& traction,
                        const FlattenOptions& given, const Progress& progress)
{
    const auto clock = std::chrono::steady_clock::now();
    FlattenOptions options = options_of(piece, given);
    if (piece.held.empty()) {
        options.process.contact = rubbing(piece, state(Eigen::all, piece.vertex), of_piece(traction, piece));
        return free_piece(piece, state(Eigen::all, piece.vertex), given_target, options, progress);
    }
    if (piece.hinge.empty())
        throw InputError(
            fmt::format("the freed faces around face {} touch the fixed ones in single vertices only; free or "
                        "fix the faces between them",
                        piece.face[0]));
    const PiecePicture picture = picture_of(piece, state(Eigen::all, piece.vertex), given_target);
    const TargetSurface& target = picture.target;
    if (picture.ring && options.process.rolling)
        throw InputError(
            fmt::format("the freed faces around face {} go all the way around the {}: projected onto it the rolling "
                        "direction differs everywhere; leave it out, or cut the part open",
                        piece.face[0], name(target)));

    ExternalForces external;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero(); // near the origin digits are not lost
    if (!picture.ring)                                // whose picture has its own
        middle = picture.held.rowwise().mean();
    for (size_t k = 0; k < piece.held.size(); ++k)
        external.held.push_back({piece.held[k], picture.held.col(Eigen::Index(k)) - middle});
    external.plane = axes_at(target, middle);
    external.traction = of_piece(traction, piece);
    if (external.any())
        external.slip = slip_on(piece, state(Eigen::all, piece.vertex), target, picture.held.col(0), middle);

    std::vector<Element> element = elements(piece.mesh);
    const auto measure = [&](const Eigen::Matrix2Xd& X) { take_lengths(piece, picture, X, middle, element); };
    progress.checkpoint(0, "ordering the equations");
    BlockMatrix matrix(piece.mesh.triangle, piece.mesh.vertices());
    Cholesky cholesky(matrix);
    const double pull = pull_of(external, piece.mesh, options);
    const Eigen::Matrix<double, 3, 2> plane = external.plane;
    SolveContext context{piece.mesh,          element, options, std::move(external), plane, std::move(matrix),
                         std::move(cholesky), true,    pull};
    SolvedPiece result;
    const PieceStart start = start_of(part, state, fixed, piece, picture, context, measure, progress.part(0.03, 0.2));
    result.report.start = start.method;
    measure(start.position);
    Eigen::Matrix2Xd X =
        solve(context, start.position, result.report, progress.part(0.2, picture.true_lengths() ? 1 : 0.6));
    if (!picture.true_lengths())
        X = in_rounds(context, measure, std::move(X), name(target), result.report, progress.part(0.6, 1));

    result.face = face_fields(piece.mesh, element, {X}, solved_sheet(context, result.report));
    X.colwise() += middle;
    if (const int f = first_flipped(piece, picture, X); f >= 0)
        throw SolveError(
            fmt::format("face {} is too thin on the target for the arithmetic; mesh the part more evenly", f));
    if (!picture.ring)
        require_beside_apex(piece, target, X);
    result.position.resize(3, X.cols());
    for (Eigen::Index v = 0; v < X.cols(); ++v)
        result.position.col(v) = picture.point(X.col(v));
    result.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    return result;
}

} // namespace spia
