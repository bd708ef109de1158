#pragma once
#include <memory>
#include <string>
#include <vector>

#include "app/viewer/model/document/document.h"

namespace spia::viewer {

/// The region whose name and kind are being edited.
struct EditedRegion {
    int region = 0;
    std::string name;
    bool appears = true;                  ///< in this frame
    std::shared_ptr<const PartFile> part; ///< with `faces`: which region that was
    std::vector<int> faces;
    bool asks_force = false; ///< the field of the tool's force takes the keyboard next
};

inline EditedRegion edit_of(const Document& document, int region)
{
    const FaceRegion& edited = document.regions[size_t(region)];
    return {region, edited.name, true, document.session.part, edited.faces};
}

/// Whether that region is still there: undo and another part take it away, or put another one in
/// its place.
inline bool still_there(const EditedRegion& edited, const Document& document)
{
    return edited.part == document.session.part && size_t(edited.region) < document.regions.size() &&
           document.regions[size_t(edited.region)].faces == edited.faces;
}

} // namespace spia::viewer
