#include "engine/unfold/step/unfold_script.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "engine/core/error.h"
#include "engine/forming/process/process.h"
#include "engine/forming/process/rolling.h"
#include "engine/forming/solver/flips.h"
#include "engine/forming/solver/placing.h"
#include "engine/forming/solver/sheet_fields.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/topology.h"
#include "engine/options/advice.h"
#include "engine/unfold/step/target_friction.h"
#include "engine/unfold/step/upright.h"
#include "engine/unfold/target/fit_height.h"
#include "engine/unfold/target/turn_target.h"

namespace spia {
namespace {

SheetFields unformed(const TriMesh& part, double thickness)
{
    const Eigen::Index count = part.triangles();
    SheetFields fields = sized_fields(count);
    for (const auto& [name, field] : sheet_scalars)
        (fields.*field).setZero();
    fields.thickness.setConstant(thickness);
    for (Eigen::Index f = 0; f < count; ++f)
        fields.direction_major.col(f) =
            (part.position.col(part.triangle(1, f)) - part.position.col(part.triangle(0, f))).normalized();
    fields.necking.setZero();
    return fields;
}

Eigen::VectorXd sheet_thickness(const TriMesh& part, const FlattenOptions& options)
{
    Eigen::VectorXd thickness = Eigen::VectorXd::Constant(part.triangles(), options.thickness);
    for (const auto& piece : options.process.tailored)
        for (const int f : piece.faces)
            thickness[f] = piece.thickness;
    return thickness;
}

double diagonal(const TriMesh& mesh, const std::vector<int>& faces)
{
    Eigen::AlignedBox3d box;
    for (const int f : faces)
        for (const int v : mesh.triangle.col(f))
            box.extend(mesh.position.col(v));
    return box.diagonal().norm();
}

/// The target where the script leaves it to be found with a distance of its own, or moves it.
std::optional<TargetSurface> target_of(const TriMesh& now, const PlannedStep& step)
{
    std::optional<TargetSurface> target = step.pick.target;
    if (!target && step.carrying_lost)
        throw InputError("the fixed faces of its target are no longer on the part; " + mention(advice::other_carriers));
    if (!target && (step.within_mm > 0 || step.offset_mm != 0 || step.kind == UnfoldKind::unroll)) {
        const std::vector<int>& faces = carrying_faces(step);
        if (faces.empty())
            throw InputError("nothing carries the target; name the faces that do, or give one");
        const double within = std::max(1e-4, step.within_mm / diagonal(now, faces));
        std::optional<TargetFit> fit = fit_target(now, faces, within);
        // as unfold_step() does where nothing is moved
        if (!fit && step.kind == UnfoldKind::lay && step.within_mm == 0)
            fit = fit_height(now, faces);
        if (!fit)
            throw InputError(fmt::format("the carrying faces around face {} lie on no plane, cylinder or cone within "
                                         "{:.3g} mm; {}",
                                         faces[0], within * diagonal(now, faces), mention(advice::closer_carriers)));
        target = fit->face;
    }
    if (target && step.offset_mm != 0)
        target = moved_out(*target, step.offset_mm);
    return target;
}

PlaneFace mean_plane(const TriMesh& now)
{
    const Eigen::Matrix3Xd normal = area_vectors(now);
    Eigen::Vector3d mean = normal.rowwise().sum();
    if (mean.norm() < 1e-6 * normal.colwise().norm().sum()) // a part that looks every way alike
        mean = Eigen::Vector3d::UnitZ();
    mean.normalize();
    Eigen::Matrix<double, 3, 2> axes;
    axes.col(0) = mean.unitOrthogonal();
    axes.col(1) = mean.cross(axes.col(0));
    return {now.position.rowwise().mean(), axes};
}

/// The chords of the mesh are laid out as the arcs over them: what that strains is told by the
/// fields.
void unroll(const TriMesh& part, const PlannedStep& step, const FlattenOptions& options, UnfoldState& state)
{
    constexpr double beside = 1e-3, own_plane = 1e-9; // of the part
    const TriMesh now{state.position, part.triangle};
    std::vector<std::array<int, 2>> edges;
    const std::vector<EdgeUse> uses = edge_uses(part.triangle);
    for_each_edge(uses, [&](size_t begin, size_t) { edges.push_back({uses[begin].low, uses[begin].high}); });
    const TargetSurface target = *target_of(now, step);
    const TargetSurface face = turned_towards(target, now.position, edges).value_or(target);
    const std::optional<Eigen::Matrix2Xd> flat = unwound(face, now.position, edges);
    if (!flat)
        throw InputError("the part goes all around the face that is to be unrolled; cut it open along a line first");
    const Eigen::Matrix2Xd& places = *flat;
    for (int v = 0; v < now.vertices(); ++v) {
        const Eigen::Vector3d x = now.position.col(v);
        const double off = (x - placed(face, developed(face, x))).norm();
        if (off > std::max(2 * step.within_mm, beside * bounding_diagonal(part)))
            throw InputError(
                fmt::format("vertex {} is {:.3g} mm off the {} that is to be unrolled; lay its faces on it first", v,
                            off, name(face)));
    }
    const PlaneFace plane = tangent_plane(face, places);
    for (int v = 0; v < now.vertices(); ++v)
        state.position.col(v) = placed(TargetSurface(plane), places.col(v));
    state.face =
        face_fields(part, elements(part), {places},
                    sheet_of(options.material, options.thickness, options.curve, options.process, part, plane.axes));
    state.necking = state.face.necking.sum();
    state.plain = name(face);
    state.overlap =
        landed_overlap({state.position, part.triangle}, plane, own_plane * bounding_diagonal(part), step.pick.freed);
}

/// How far beside the target what lies on it is: as far as what carries it, and no less than
/// rounding.
double carried_within(const Eigen::Matrix3Xd& position, const TriMesh& part, const PlannedStep& step,
                      const UnfoldStepResult& result)
{
    constexpr double rounding = 1e-9; // of the part
    double within = std::max(rounding * bounding_diagonal(part), result.target.distance_mm);
    for (const int f : carrying_faces(step))
        for (const int v : part.triangle.col(f)) {
            const Eigen::Vector3d x = position.col(v);
            within = std::max(within, (x - placed(result.target.face, developed(result.target.face, x))).norm());
        }
    return (1 + rounding) * within;
}

void lay(const TriMesh& part, const PlannedStep& step, const FlattenOptions& options, const Progress& progress,
         UnfoldState& state)
{
    FlattenOptions own = options;
    own.tolerance = step.tolerance.value_or(options.tolerance);
    own.most_energy_steps = step.most_energy_steps.value_or(options.most_energy_steps);
    own.most_newton_steps = step.most_newton_steps.value_or(options.most_newton_steps);
    const TriMesh now{state.position, part.triangle};
    UnfoldPick pick = step.pick;
    pick.target = target_of(now, step);
    if (step.kind == UnfoldKind::flatten && !pick.target)
        pick.target = mean_plane(now);
    const UnfoldStepResult result = unfold_step(part, state.position, pick, own, progress);
    state.position = result.position;
    put_fields(result.face, result.freed, state.face);
    state.on = result.target;
    state.plain = name(result.target.face);
    state.converged = result.converged();
    for (const UnfoldedPiece& piece : result.piece) {
        state.friction_share = std::min(state.friction_share, piece.report.process_share);
        state.system = std::max(state.system, piece.report.system);
        state.trusted_strain = state.trusted_strain > 0 ? std::min(state.trusted_strain, piece.report.trusted_strain)
                                                        : piece.report.trusted_strain;
        if (!piece.report.whole() && state.reason.empty())
            state.reason = fmt::format("the piece around face {}: {}", piece.faces[0], piece.report.reason);
    }
    state.necking = result.necking_triangles;
    state.overlap = landed_overlap({state.position, part.triangle}, result.target.face,
                                   carried_within(state.position, part, step, result), step.pick.freed);
    if (step.kind == UnfoldKind::lay && !carrying_faces(step).empty())
        state.reach = target_reach({state.position, part.triangle}, carrying_faces(step), result.freed, step.extent_mm);
}

/// The part in the plane in which it lies, seen from the outer side, straight on the sheet.
std::optional<Blank> blank_of(const TriMesh& part, const Eigen::Matrix3Xd& position, const ProcessConditions& process,
                              int& flipped)
{
    constexpr double flat = 1e-6; // of the part
    const TriMesh now{position, part.triangle};
    const Eigen::Matrix3Xd arm = position.colwise() - position.rowwise().mean();
    const Eigen::Vector3d normal = area_vectors(now).rowwise().sum().normalized();
    if (!((normal.transpose() * arm).cwiseAbs().maxCoeff() <= flat * bounding_diagonal(now)))
        return std::nullopt;
    const Eigen::Matrix<double, 3, 2> plane = blank_plane(normal);
    Blank blank{upright(part, plane.transpose() * arm, rolling_in(process, plane))};
    flipped = flipped_triangles(part.triangle, blank.position);
    return blank;
}

/// Names the step and what of its friction is wrong.
void require_friction(const TriMesh& part, const PlannedStep& step)
{
    if (!step.pick.friction)
        return;
    const std::string what = fmt::format("step \"{}\": its friction", step.name);
    if (step.kind != UnfoldKind::lay)
        throw InputError(what + ": only a step that lays faces on a target has a tool that could rub on them");
    require_friction_on(*step.pick.friction, step.pick.freed, part, what);
}

void require_extent(const PlannedStep& step)
{
    if (!step.extent_mm)
        return;
    if (!(*step.extent_mm > 0) || !std::isfinite(*step.extent_mm))
        throw InputError(fmt::format("step \"{}\": the extent of its target is {} mm; it must be positive", step.name,
                                     *step.extent_mm));
    if (step.kind != UnfoldKind::lay || carrying_faces(step).empty())
        throw InputError(fmt::format("step \"{}\": the extent of a target is counted from the faces that carry it, and "
                                     "nothing carries it in this step; leave the extent out",
                                     step.name));
}

void require_script(const TriMesh& part, const UnfoldScript& script, const UnfoldRun* before, size_t keep)
{
    for (const PlannedStep& step : script) {
        require_friction(part, step);
        require_extent(step);
    }
    if (script.empty())
        throw InputError("the script has no step; there is nothing to unfold");
    if (keep > script.size() || (keep > 0 && (!before || before->states.size() < keep)))
        throw InputError(fmt::format("cannot go on after step {}: only {} steps are done", keep,
                                     before ? std::min(before->states.size(), script.size()) : 0));
}

} // namespace

bool creased(const TargetFit& target, double diagonal)
{
    constexpr double far = 2e-4, turned = 3 * std::numbers::pi / 180; // of the part; radians
    return target.distance_mm > far * diagonal || target.angle > turned;
}

TargetSurface moved_out(const TargetSurface& face, double mm)
{
    if (const auto* plane = std::get_if<PlaneFace>(&face))
        return PlaneFace{plane->origin + mm * plane->axes.col(0).cross(plane->axes.col(1)), plane->axes};
    if (const auto* cylinder = std::get_if<CylinderFace>(&face)) {
        CylinderFace moved = *cylinder;
        moved.radius += cylinder->bulges ? mm : -mm;
        if (!(moved.radius > 0))
            throw InputError(fmt::format("a cylinder of {:.4g} mm radius vanishes if it is moved by {:.4g} mm",
                                         cylinder->radius, mm));
        return moved;
    }
    // along its plane's normal: nearly square to a flat-ish face
    if (const auto* height = std::get_if<HeightFace>(&face)) {
        HeightFace moved = *height;
        moved.origin += mm * moved.axes.col(0).cross(moved.axes.col(1));
        return moved;
    }
    ConeFace moved = std::get<ConeFace>(face);
    moved.apex -= (moved.bulges ? mm : -mm) / std::sin(moved.half_angle) * moved.axis;
    return moved;
}

PlaneFace tangent_plane(const TargetSurface& face, const Eigen::Matrix2Xd& places)
{
    const Eigen::Vector2d middle = (places.rowwise().minCoeff() + places.rowwise().maxCoeff()) / 2;
    const double step = 1e-4 * (places.rowwise().maxCoeff() - places.rowwise().minCoeff()).norm();
    Eigen::Matrix<double, 3, 2> axes;
    for (int k = 0; k < 2; ++k)
        axes.col(k) = (placed(face, middle + step * Eigen::Vector2d::Unit(k)) -
                       placed(face, middle - step * Eigen::Vector2d::Unit(k)))
                          .normalized();
    axes.col(1) = (axes.col(1) - axes.col(0).dot(axes.col(1)) * axes.col(0)).normalized();
    return {placed(face, middle) - axes * middle, axes};
}

UnfoldRun run_unfolding(const TriMesh& part, const UnfoldScript& script, const FlattenOptions& options,
                        const Progress& progress, const UnfoldRun* before, size_t keep,
                        const std::function<void(const UnfoldRun& so_far)>& ended)
{
    require_script(part, script, before, keep);
    UnfoldRun run;
    if (keep > 0)
        run.states.assign(before->states.begin(), before->states.begin() + Eigen::Index(keep));
    UnfoldState state;
    if (keep > 0)
        state = run.states.back();
    else {
        state.position = part.position;
        state.face = unformed(part, options.thickness);
        state.face.thickness = sheet_thickness(part, options);
        state.step = Eigen::VectorXi::Zero(part.triangles());
    }
    for (size_t k = keep; k < script.size(); ++k) {
        const auto clock = std::chrono::steady_clock::now();
        const PlannedStep& step = script[k];
        const double missing = double(script.size() - keep);
        const Progress own = progress.part(double(k - keep) / missing, double(k + 1 - keep) / missing);
        UnfoldState next;
        next.name = step.name;
        next.position = state.position;
        next.face = state.face;
        next.step = state.step;
        try {
            own.checkpoint(0, step.name);
            if (step.kind == UnfoldKind::unroll)
                unroll(part, step, options, next);
            else
                lay(part, step, options, own, next);
        } catch (const InputError& error) {
            run.failure = error.what();
        } catch (const SolveError& error) {
            run.failure = error.what();
        } catch (const Cancelled&) {
            throw UnfoldingCancelled(script, std::move(run));
        }
        if (!run.failure.empty())
            return run;
        for (const int f : step.pick.freed)
            next.step[f] = int(k + 1);
        next.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
        state = next;
        run.states.push_back(std::move(next));
        if (ended)
            ended(run);
    }
    run.blank = blank_of(part, state.position, options.process, run.flipped);
    return run;
}

} // namespace spia
