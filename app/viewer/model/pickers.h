#pragma once
#include <memory>
#include <optional>

#include "app/viewer/model/document.h"
#include "app/viewer/model/picking.h"
#include "app/viewer/model/state.h"
#include "app/viewer/model/vertex_picking.h"

namespace spia::viewer {

/// Search structures of the part and its blank, made when first needed and kept as long as these are the same.
class Pickers {
public:
    /// That of a view: the blank's, or the part's for the others. Null if there is nothing to pick yet.
    const RayPicker* picker(const Session& session, View view);
    /// The faces as the view shows them. Null likewise.
    const TriMesh* mesh(const Session& session, View view);
    const RegionSearch& regions(const Session& session); ///< the part must be there
    const CornerTrack& track(const Session& session);    ///< the blank must be there
    /// The part must be there.
    const BoundaryVertices& boundary(const Session& session, View view);
    /// Vertices of the outer boundary in their order; before there is a blank the longest one counts as that.
    /// @throws InputError if there is none
    const std::vector<int>& outline(const Session& session);
    /// What a click would pick. Nothing likewise where the view shows none of the part.
    std::optional<int> vertex_at(const Session& session, const PickVertex& pick, const Camera& camera);

private:
    void follow(const Session& session);

    std::shared_ptr<const PartFile> part_;
    std::shared_ptr<const FlattenResult> blank_;
    std::optional<TriMesh> flat_;
    std::optional<RayPicker> on_part_, on_blank_;
    std::optional<RegionSearch> regions_;
    std::optional<CornerTrack> track_;
    std::optional<BoundaryVertices> boundary_on_part_, boundary_on_blank_;
    std::optional<std::vector<int>> longest_;
};

} // namespace spia::viewer
