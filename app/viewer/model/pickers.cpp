#include "app/viewer/model/pickers.h"

#include "app/viewer/model/flat_mesh.h"
#include "engine/core/error.h"
#include "engine/mesh/topology.h"

namespace spia::viewer {

void Pickers::follow(const Session& session)
{
    if (part_ != session.part) {
        part_ = session.part;
        on_part_.reset();
        regions_.reset();
        boundary_on_part_.reset();
        longest_.reset();
    }
    if (blank_ != session.blank || !part_) {
        blank_ = session.blank;
        flat_.reset();
        on_blank_.reset();
        track_.reset();
        boundary_on_blank_.reset();
    }
}

const TriMesh* Pickers::mesh(const Session& session, View view)
{
    follow(session);
    if (!part_ || (view == View::blank && !blank_))
        return nullptr;
    if (view != View::blank)
        return &part_->mesh;
    if (!flat_)
        flat_ = flat_mesh(part_->mesh, blank_->blank);
    return &*flat_;
}

const RayPicker* Pickers::picker(const Session& session, View view)
{
    const TriMesh* shown = mesh(session, view);
    if (!shown)
        return nullptr;
    std::optional<RayPicker>& picker = view == View::blank ? on_blank_ : on_part_;
    if (!picker)
        picker.emplace(*shown);
    return &*picker;
}

const RegionSearch& Pickers::regions(const Session& session)
{
    follow(session);
    if (!regions_)
        regions_.emplace(part_->mesh);
    return *regions_;
}

const CornerTrack& Pickers::track(const Session& session)
{
    follow(session);
    if (!track_)
        track_ = corner_track(part_->mesh, blank_->blank);
    return *track_;
}

const BoundaryVertices& Pickers::boundary(const Session& session, View view)
{
    const TriMesh& shown = *mesh(session, view);
    std::optional<BoundaryVertices>& boundary = view == View::blank ? boundary_on_blank_ : boundary_on_part_;
    if (!boundary)
        boundary = boundary_vertices(shown);
    return *boundary;
}

const std::vector<int>& Pickers::outline(const Session& session)
{
    follow(session);
    if (blank_)
        return track(session).vertex;
    if (!longest_) {
        const auto loops = boundary_loops(part_->mesh);
        if (loops.empty())
            throw InputError("The part is closed all around and has no outline.");
        longest_ = loops.front();
    }
    return *longest_;
}

std::optional<int> Pickers::vertex_at(const Session& session, const PickVertex& pick, const Camera& camera)
{
    const RayPicker* on = picker(session, pick.view);
    if (!on)
        return {};
    const TriMesh& shown = *mesh(session, pick.view);
    return pick.boundary ? boundary_vertex_at(pick, camera, shown, boundary(session, pick.view), *on)
                         : viewer::vertex_at(pick, camera, shown, *on);
}

} // namespace spia::viewer
