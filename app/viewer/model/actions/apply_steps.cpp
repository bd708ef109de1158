#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/viewer/model/actions/apply.h"
#include "app/viewer/model/document/chain.h"
#include "engine/mesh/region.h"
#include "engine/report/text/lengths.h"

namespace spia::viewer {
namespace {

/// With all triangles of the faces of the file that some are of: a script of steps names no halves
/// of quads.
std::vector<int> whole_faces(const PartFile& part, const std::vector<int>& triangles)
{
    if (part.source_face.empty())
        return triangles;
    std::vector<int> faces;
    for (const int f : triangles)
        faces.push_back(part.source_face[size_t(f)]);
    std::sort(faces.begin(), faces.end());
    std::vector<int> whole;
    for (int f = 0; f < part.mesh.triangles(); ++f)
        if (std::binary_search(faces.begin(), faces.end(), part.source_face[size_t(f)]))
            whole.push_back(f);
    return whole;
}

} // namespace

void ViewerModel::Apply::require_idle() const
{
    part();
    if (model.busy())
        throw Busy("Wait for the running job to end, or cancel it.");
}

size_t ViewerModel::Apply::step(int number) const
{
    if (number < 0 || size_t(number) >= document.steps.size())
        throw InputError(document.steps.empty()
                             ? "There are no steps yet: propose some, or add one."
                             : fmt::format("There is no step {}; the list has {}.", number + 1, document.steps.size()));
    return size_t(number);
}

void ViewerModel::Apply::change_steps(std::string name, StepList steps, bool merge)
{
    change(std::move(name), merge);
    document.steps = std::move(steps);
}

static int largest_face(const TriMesh& part, const std::vector<int>& faces)
{
    const auto area = [&](int face) {
        const Eigen::Matrix3d c = part.position(Eigen::all, part.triangle.col(face));
        return (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0)).squaredNorm();
    };
    return *std::max_element(faces.begin(), faces.end(), [&](int a, int b) { return area(a) < area(b); });
}

void ViewerModel::Apply::operator()(const ProposeSteps& action)
{
    require_idle();
    if (action.keep && (*action.keep < 0 || *action.keep >= part().mesh.triangles()))
        throw InputError(fmt::format("The part has no face {}.", *action.keep));
    std::optional<int> keep = action.keep;
    for (const FaceRegion& region : document.regions) // what the user has fixed stays where it is
        if (!keep && region.kind == RegionKind::fixed && !region.faces.empty())
            keep = largest_face(part().mesh, region.faces); // which is hardly one of a bend
    model.start_steps("Proposing steps",
                      [part = session.part, bends = document.bends, keep](const Progress& progress, const StepsSoFar&) {
                          return propose_steps(part, bends, keep, progress);
                      });
}

void ViewerModel::Apply::operator()(const RunSteps&)
{
    require_idle();
    if (document.steps.empty())
        throw InputError("There are no steps yet: propose some, or add one.");
    if (all_steps_done(document)) {
        model.say(Severity::hint, "All steps are up to date.");
        return;
    }
    model.run_missing_steps();
}

void ViewerModel::Apply::operator()(const UseBlankOfSteps& action)
{
    require_idle();
    if (first_stale(document) == Stage::read)
        throw InputError("The part must be read again first; then run the steps.");
    if (!all_steps_done(document))
        throw InputError(document.steps.empty() ? "There are no steps yet: propose some, or add one."
                                                : "Run all steps first; then their blank can be used.");
    const std::shared_ptr<const StepsRun>& last = document.unfolding;
    if (!last->run.blank)
        throw InputError("After the last step the part is not flat yet; add a step.");
    if (last->run.flipped > 0)
        throw InputError("Triangles of the blank of the steps are flipped; unfold in smaller steps there.");
    const BlankOfSteps wanted{{last, &last->run}, action.polish};
    if (session.options.steps == wanted && !first_stale(document)) {
        model.say(Severity::hint, "The blank of the steps is in use already, and everything is up to date.");
        return;
    }
    dismiss_before_run(state.messages);
    const bool unsaved = state.document.unsaved;
    change(action.polish ? "Polish the blank of the steps" : "Use the blank of the steps");
    session.options.steps = wanted;
    model.show_step(std::nullopt, 0); // the part is looked at again, with the strains of its blank
    model.run_to(Stage::fit, action.polish ? "Polishing the blank of the steps" : "Using the blank of the steps");
    if (model.chain_job_)
        model.on_cancel_.unsaved_before = unsaved;
}

void ViewerModel::Apply::operator()(const OpenSteps& action)
{
    require_idle();
    model.start_steps("Opening the steps", [part = session.part, bends = document.bends,
                                            file = action.file](const Progress& progress, const StepsSoFar&) {
        return open_steps(part, bends, file, progress);
    });
}

void ViewerModel::Apply::operator()(const SaveSteps& action)
{
    require_idle();
    if (document.steps.empty())
        throw InputError("There are no steps yet: propose some, or add one.");
    model.start_steps("Saving the steps", [part = session.part, bends = document.bends, steps = document.steps,
                                           file = action.file](const Progress& progress, const StepsSoFar&) {
        return save_steps(part, bends, steps, file, progress);
    });
}

void ViewerModel::Apply::operator()(const AddStep& action)
{
    part();
    const FaceRegion& fixed = document.regions[region(action.fixed)];
    if (!action.freed && document.selected.empty())
        throw InputError("Select the faces to unfold first, or make a region of them.");
    if (action.freed == action.fixed)
        throw InputError(
            fmt::format("The region \"{}\" cannot be both fixed and unfolded; choose another one.", fixed.name));
    if (action.plane_of && !action.target.fitted())
        throw InputError("A step has one target: numbers of its own, or the plane of a region.");
    const std::vector<int>& picked = action.freed ? document.regions[region(*action.freed)].faces : document.selected;
    const std::vector<int> freed = whole_faces(part(), picked);
    if (freed.size() > picked.size())
        model.say(Severity::hint,
                  fmt::format("{} more triangles were added, so that each face of the file is unfolded as a whole.",
                              freed.size() - picked.size()));
    std::vector<int> both;
    std::set_intersection(fixed.faces.begin(), fixed.faces.end(), freed.begin(), freed.end(), std::back_inserter(both));
    if (!both.empty())
        throw InputError(
            fmt::format("{} {} to unfold also belong{} to the fixed region \"{}\"; remove them from one of the two.",
                        both.size(), both.size() == 1 ? "face" : "faces", both.size() == 1 ? "s" : "", fixed.name));
    PlannedStep made;
    made.name = !action.name.empty() ? action.name
                                     : fmt::format("{} onto {}",
                                                   action.freed ? document.regions[size_t(*action.freed)].name
                                                                : fmt::format("{} faces", freed.size()),
                                                   fixed.name);
    made.pick.freed = freed;
    made.pick.fixed = inverted(freed, part().mesh.triangles());
    made.pick.carrying = fixed.faces;
    StepTarget target = action.target;
    if (action.plane_of)
        target = {.plane = plane_before(document.steps.size(), document.regions[region(*action.plane_of)].faces)};
    made.pick.target = face_of(target, part().mesh, made.pick);
    StepList steps = document.steps;
    steps.push_back(std::make_shared<PlannedStep>(std::move(made)));
    change_steps("Add step", std::move(steps));
    model.show_step(int(document.steps.size()) - 1, step_position(state));
}

void ViewerModel::Apply::operator()(const ChangeStep& action)
{
    const size_t number = step(action.step);
    if (action.name.empty())
        throw InputError("A step needs a name.");
    if (!std::isfinite(action.offset_mm) || !(action.within_mm >= 0))
        throw InputError("The offset of a step must be a length, and the distance within which its target is fitted 0 "
                         "or more.");
    if (action.tolerance && !(*action.tolerance >= least_step_tolerance && *action.tolerance <= most_step_tolerance))
        throw InputError(
            fmt::format("The tolerance of a step must be from {} to {}.", least_step_tolerance, most_step_tolerance));
    const PlannedStep& before = *document.steps[number];
    if (action.extent_mm &&
        (!(*action.extent_mm > 0) || before.kind != UnfoldKind::lay || carrying_faces(before).empty()))
        throw InputError("The extent of a target must be a length above 0, measured from its fixed faces.");
    if (before.kind != UnfoldKind::lay && action.offset_mm != before.offset_mm)
        throw InputError("Only a step with a target can have an offset.");
    PlannedStep changed = before;
    changed.name = action.name;
    changed.offset_mm = action.offset_mm;
    changed.within_mm = action.within_mm;
    changed.extent_mm = action.extent_mm;
    changed.tolerance = action.tolerance;
    if (action.target && *action.target != numbers_of(before)) {
        changed.pick.target = face_of(*action.target, part().mesh, before.pick);
        if (changed.pick.target && before.kind != UnfoldKind::lay)
            throw InputError("Only a step that lays faces on a target can have another target.");
    }
    if (action.friction != numbers_of(before.pick.friction)) {
        if (action.friction && before.kind != UnfoldKind::lay)
            throw InputError("Only a step that lays faces on a target can have friction.");
        const std::vector<int> faces = before.pick.friction ? before.pick.friction->faces : std::vector<int>();
        changed.pick.friction = action.friction ? std::optional(friction_of(*action.friction, faces)) : std::nullopt;
    }
    replace_step("Change step", number, std::move(changed), true);
}

void ViewerModel::Apply::replace_step(std::string name, size_t number, PlannedStep changed, bool merge)
{
    StepList steps = document.steps;
    steps[number] = std::make_shared<PlannedStep>(std::move(changed));
    change_steps(std::move(name), std::move(steps), merge);
}

const std::vector<int>& ViewerModel::Apply::faces_or_selected(std::optional<int> number, const char* what_for) const
{
    const std::vector<int>& faces = number ? document.regions[region(*number)].faces : document.selected;
    if (faces.empty())
        throw InputError(fmt::format("Select the faces {} first, or make a region of them.", what_for));
    return faces;
}

const PlannedStep& ViewerModel::Apply::laying_step(int number) const
{
    const PlannedStep& wanted = *document.steps[step(number)];
    if (wanted.kind != UnfoldKind::lay)
        throw InputError("Only a step that lays faces on a target can have another target.");
    return wanted;
}

TargetPlane ViewerModel::Apply::plane_before(size_t step, const std::vector<int>& faces)
{
    const size_t known = std::min(step, steps_done(document));
    for (size_t k = known; k < step; ++k) {
        const std::vector<int>& moved = document.steps[k]->pick.freed;
        if (std::any_of(faces.begin(), faces.end(),
                        [&](int f) { return std::binary_search(moved.begin(), moved.end(), f); }))
            throw InputError(fmt::format(
                "Step {} moves some of these faces; run the earlier steps first, so that their plane is known.",
                k + 1));
    }
    const TriMesh now{unfolded_places(document, double(known)), part().mesh.triangle};
    const PlaneThrough through = plane_through(now, faces);
    model.say(Severity::hint,
              fmt::format("The target is the plane through {} faces, which are up to {} from it.", faces.size(),
                          length_text(through.distance_mm, state.preferences.lengths, 3)));
    return through.plane;
}

void ViewerModel::Apply::operator()(const SetTargetPlane& action)
{
    PlannedStep changed = laying_step(action.step);
    const std::vector<int>& faces = faces_or_selected(action.region, "for the plane");
    const StepTarget target{.plane = plane_before(size_t(action.step), faces)};
    changed.pick.target = face_of(target, part().mesh, changed.pick);
    replace_step("Set target plane", size_t(action.step), std::move(changed));
}

void ViewerModel::Apply::operator()(const SetCarrying& action)
{
    PlannedStep changed = laying_step(action.step);
    const std::vector<int>& faces = faces_or_selected(action.region, "for the target");
    const std::vector<int>& freed = changed.pick.freed;
    const auto moves = std::count_if(faces.begin(), faces.end(),
                                     [&](int f) { return std::binary_search(freed.begin(), freed.end(), f); });
    if (moves > 0)
        throw InputError(
            fmt::format("{} of these faces {} moved by the step and cannot define its target; choose fixed faces.",
                        moves, moves == 1 ? "is" : "are"));
    std::vector<int> fixed;
    std::set_union(changed.pick.fixed.begin(), changed.pick.fixed.end(), faces.begin(), faces.end(),
                   std::back_inserter(fixed));
    changed.pick.fixed = std::move(fixed);
    changed.pick.carrying = faces;
    changed.pick.target.reset();
    changed.carrying_lost = false;
    replace_step("Set fixed faces", size_t(action.step), std::move(changed));
}

void ViewerModel::Apply::operator()(const RemoveStep& action)
{
    const size_t number = step(action.step);
    StepList steps = document.steps;
    steps.erase(steps.begin() + long(number));
    change_steps("Remove step", std::move(steps));
    if (auto& chosen = state.view.step; chosen && *chosen >= int(number))
        chosen = document.steps.empty() ? std::nullopt : std::optional(std::max(0, *chosen - 1));
}

void ViewerModel::Apply::operator()(const MoveStep& action)
{
    const size_t from = step(action.step), to = step(action.to);
    if (from == to)
        return;
    StepList steps = document.steps;
    const auto moved = steps[from];
    steps.erase(steps.begin() + long(from));
    steps.insert(steps.begin() + long(to), moved);
    change_steps("Move step", std::move(steps));
    if (state.view.step == int(from))
        state.view.step = int(to);
}

void ViewerModel::Apply::operator()(const ShowStep& action)
{
    part();
    if (action.step)
        step(*action.step);
    const double done = double(steps_done(document));
    if (action.position && !(*action.position >= 0 && *action.position <= double(document.steps.size())))
        throw InputError(
            fmt::format("The slider goes from 0, the part, to {}, after the last step.", document.steps.size()));
    if (action.position && *action.position > done)
        model.say(Severity::hint, "The steps up to there have to be run first.");
    const double position = std::min(done, action.position.value_or(action.step ? double(*action.step + 1) : 0));
    std::optional<int> shown = action.step;
    if (!shown && action.position && *action.position > 0)
        shown = std::max(0, int(std::ceil(position)) - 1);
    model.show_step(shown, position);
}

} // namespace spia::viewer
