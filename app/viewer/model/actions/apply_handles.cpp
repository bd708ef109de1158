#include <algorithm>
#include <fmt/core.h>

#include "app/viewer/model/actions/apply.h"
#include "app/viewer/model/picking/handles.h"
#include "app/viewer/model/picking/measuring.h"
#include "app/viewer/model/picking/picking.h"
#include "engine/pipeline/files/deform_file.h"

namespace spia::viewer {

/// All or nothing: where the deformation cannot be, it stays as it was.
void ViewerModel::Apply::deform(std::string name, std::optional<Deformation> deformation, bool dragging)
{
    if (!session.surface)
        throw InputError("Make the surface first; then it can be deformed.");
    if (model.chain_job_)
        throw InputError("Wait until the surface is finished.");
    Session changed = session;
    changed.options.deformation = std::move(deformation);
    changed = deform_surface(std::move(changed), !dragging);
    change(std::move(name), true);
    if (!dragging)
        state.history.close();
    const Session before = std::exchange(session, std::move(changed));
    measure_again(document, before);
    state.shape_dragged = dragging;
    document.made_with.deformation = session.options.deformation;
}

void ViewerModel::Apply::operator()(const SetLattice& action)
{
    std::optional<Deformation> wanted = session.options.deformation;
    if (action.lattice) {
        if (!session.surface)
            throw InputError("Make the surface first; then a lattice can be added.");
        if (!wanted)
            wanted.emplace();
        wanted->lattice =
            lattice_around(fitted_patches(*session.surface), action.lattice->count, action.lattice->degree);
    } else if (wanted) {
        wanted->lattice.reset();
        if (wanted->moves.empty())
            wanted.reset();
    }
    deform(action.lattice ? "Add lattice" : "Remove lattice", std::move(wanted));
    document.lattice_points.clear();
    state.view.handles = action.lattice ? HandleKind::lattice : HandleKind::control;
}

std::vector<int>& ViewerModel::Apply::picked_handles(HandleKind kind)
{
    return kind == HandleKind::control ? document.controls : document.lattice_points;
}

void ViewerModel::Apply::pick_handles(HandleKind kind, std::vector<int> handles, PickMode mode)
{
    std::sort(handles.begin(), handles.end());
    handles.erase(std::unique(handles.begin(), handles.end()), handles.end());
    std::vector<int> now = picked(picked_handles(kind), handles, mode);
    if (now == picked_handles(kind))
        return;
    change(kind == HandleKind::control ? "Pick control points" : "Pick lattice points");
    picked_handles(kind) = std::move(now);
}

void ViewerModel::Apply::operator()(const PickHandle& action)
{
    const auto found = handle_at(action, camera(View::surface), handle_positions(session, action.kind));
    if (found)
        pick_handles(action.kind, {*found}, action.mode);
    else if (action.mode == PickMode::replace)
        pick_handles(action.kind, {}, PickMode::replace);
}

void ViewerModel::Apply::operator()(const SelectHandles& action)
{
    const Eigen::Index count = handle_positions(session, action.kind).cols();
    for (const int handle : action.handles)
        if (handle < 0 || handle >= count)
            throw InputError(fmt::format("There is no {} {}; there are {}, counted from 0.",
                                         action.kind == HandleKind::control ? "control point" : "lattice point", handle,
                                         count));
    pick_handles(action.kind, action.handles, action.mode);
}

void ViewerModel::Apply::operator()(const MoveHandles& action)
{
    const std::vector<int>& handles = picked_handles(action.kind);
    if (handles.empty())
        throw InputError(action.kind == HandleKind::control ? "Pick control points in the view of the surface first."
                                                            : "Pick lattice points in the view of the surface first.");
    deform(action.kind == HandleKind::control ? "Move control points" : "Move lattice points",
           moved(session, action.kind, handles, action.by), action.dragging);
}

void ViewerModel::Apply::operator()(const ResetHandles& action)
{
    deform("Reset deformation", reset(session.options.deformation, action.kind));
}

void ViewerModel::Apply::operator()(const OpenDeformation& action)
{
    if (!session.surface)
        throw InputError("Make the surface first; then it can be deformed.");
    deform("Open deformation", deformation_of(read_deformation(action.file), fitted_patches(*session.surface)));
    document.lattice_points.clear();
}

void ViewerModel::Apply::operator()(const SaveDeformation& action)
{
    if (!session.options.deformation)
        throw InputError("The surface is not deformed: there is nothing to save.");
    write_deformation(action.file, *session.options.deformation);
    model.say(Severity::done, fmt::format("Saved {}.", action.file.filename().string()));
}

} // namespace spia::viewer
