#pragma once
#include <memory>
#include <optional>

#include "app/viewer/model/document.h"
#include "app/viewer/model/picking.h"
#include "app/viewer/model/state.h"

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

private:
    void follow(const Session& session);

    std::shared_ptr<const PartFile> part_;
    std::shared_ptr<const FlattenResult> blank_;
    std::optional<TriMesh> flat_;
    std::optional<RayPicker> on_part_, on_blank_;
    std::optional<RegionSearch> regions_;
    std::optional<CornerTrack> track_;
};

} // namespace spia::viewer
