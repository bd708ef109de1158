#include "app/viewer/model/picking/pickers.h"

#include "app/viewer/model/picking/measuring.h"
#include "engine/core/error.h"
#include "engine/forming/flat_mesh.h"
#include "engine/mesh/topology.h"

namespace spia::viewer {

void Pickers::follow(const Session& session)
{
    if (part_ != session.part) {
        part_ = session.part;
        on_part_ = {};
        regions_ = {};
        longest_ = {};
        if (part_) {
            // In the order of the first use; once the picker is ready, the boundary is.
            on_part_.boundary = worker_.later([part = part_] { return boundary_vertices(part->mesh); });
            on_part_.picker = worker_.later([part = part_] { return RayPicker(part->mesh); });
            longest_ = worker_.later([part = part_] {
                const auto loops = boundary_loops(part->mesh);
                if (loops.empty())
                    throw InputError("The part is closed and has no outline.");
                return loops.front();
            });
            regions_ = worker_.later([part = part_] { return RegionSearch(part->mesh); });
        }
    }
    if (blank_ != session.blank || !part_) {
        blank_ = part_ ? session.blank : nullptr;
        flat_.reset();
        on_blank_ = {};
        track_ = {};
        if (blank_) {
            flat_ = std::make_shared<TriMesh>(flat_mesh(part_->mesh, blank_->blank));
            track_ = worker_.later([part = part_, blank = blank_] { return corner_track(part->mesh, blank->blank); });
            on_blank_.boundary = worker_.later([flat = flat_] { return boundary_vertices(*flat); });
            on_blank_.picker = worker_.later([flat = flat_] { return RayPicker(*flat); });
        }
    }
}

void Pickers::follow_steps(const ViewerState& state)
{
    const double position = step_position(state);
    const auto steps = size_t(position);
    on_the_way_ = position != double(steps);
    if (steps == 0 || on_the_way_) {
        unfolded_.reset();
        run_.reset();
        on_unfolded_ = {};
        return;
    }
    if (run_ == state.document.unfolding && steps_ == steps)
        return;
    run_ = state.document.unfolding;
    steps_ = steps;
    unfolded_ = std::make_shared<TriMesh>(
        TriMesh{run_->run.states[steps - 1].position, state.document.session.part->mesh.triangle});
    on_unfolded_.boundary = worker_.later([mesh = unfolded_] { return boundary_vertices(*mesh); });
    on_unfolded_.picker = worker_.later([mesh = unfolded_] { return RayPicker(*mesh); });
}

const TriMesh* Pickers::mesh(const Session& session, View view)
{
    follow(session);
    if (view == View::blank)
        return flat_.get();
    if ((view == View::part && on_the_way_) || (view == View::surface && !session.surface) ||
        (view == View::quads && !session.lifted && !session.surface)) // they show nothing
        return nullptr;
    if (view == View::part && unfolded_)
        return unfolded_.get();
    return part_ ? &part_->mesh : nullptr;
}

const RayPicker* Pickers::picker(const Session& session, View view)
{
    return mesh(session, view) ? &search(view).picker.get() : nullptr;
}

const RayPicker* Pickers::ready_picker(const Session& session, View view)
{
    return mesh(session, view) ? search(view).picker.peek() : nullptr;
}

const TriMesh* Pickers::measuring_mesh(const ViewerState& state, View view)
{
    const Session& session = state.document.session;
    if (view == View::part || view == View::blank)
        return mesh(session, view);
    MeasuredOn& on = measured_[view == View::quads ? 0 : 1];
    const LaterResults now = view == View::quads ? quads_shown(state) : surface_shown(state);
    if (now.lifted != on.of.lifted || now.surface != on.of.surface || session.deformed != on.deformed) {
        on = {now, session.deformed, measured_mesh(state, view), nullptr};
        if (on.mesh)
            on.picker = std::make_shared<RayPicker>(*on.mesh);
    }
    return on.mesh.get();
}

const RayPicker* Pickers::measuring_picker(const ViewerState& state, View view)
{
    if (view == View::part || view == View::blank)
        return picker(state.document.session, view);
    return measuring_mesh(state, view) ? measured_[view == View::quads ? 0 : 1].picker.get() : nullptr;
}

const RegionSearch& Pickers::regions(const Session& session)
{
    follow(session);
    return regions_.get();
}

const CornerTrack& Pickers::track(const Session& session)
{
    follow(session);
    return track_.get();
}

std::optional<std::array<int, 4>> Pickers::corners(const Session& session)
{
    if (!session.options.corners)
        return session.grid ? std::optional(session.grid->boundary.corner) : std::nullopt;
    if (chosen_.of != session.part || chosen_.number != *session.options.corners)
        chosen_ = {session.part, *session.options.corners, corners_called(*session.part, *session.options.corners)};
    return chosen_.vertex;
}

const BoundaryVertices& Pickers::boundary(const Session& session, View view)
{
    follow(session);
    return search(view).boundary.get();
}

const std::vector<int>& Pickers::outline(const Session& session)
{
    follow(session);
    return blank_ ? track_.get().vertex : longest_.get();
}

const std::vector<int>* Pickers::ready_outline(const Session& session)
{
    follow(session);
    if (!blank_)
        return longest_.peek();
    const CornerTrack* track = track_.peek();
    return track ? &track->vertex : nullptr;
}

std::optional<int> Pickers::vertex_at(const Session& session, const PickVertex& pick, const Camera& camera,
                                      const std::optional<HalfSpace>& kept)
{
    const RayPicker* on = picker(session, pick.view);
    if (!on)
        return {};
    const TriMesh& shown = *mesh(session, pick.view);
    return pick.boundary ? boundary_vertex_at(pick, camera, shown, boundary(session, pick.view), *on, kept)
                         : viewer::vertex_at(pick, camera, shown, *on, kept);
}

} // namespace spia::viewer
