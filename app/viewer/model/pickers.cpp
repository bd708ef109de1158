#include "app/viewer/model/pickers.h"

#include "app/viewer/model/flat_mesh.h"

namespace spia::viewer {

void Pickers::follow(const Session& session)
{
    if (part_ != session.part) {
        part_ = session.part;
        on_part_.reset();
        regions_.reset();
    }
    if (blank_ != session.blank || !part_) {
        blank_ = session.blank;
        flat_.reset();
        on_blank_.reset();
        track_.reset();
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

} // namespace spia::viewer
