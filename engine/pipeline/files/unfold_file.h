#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/part/part_file.h"
#include "engine/unfold/plan/bends.h"
#include "engine/unfold/step/unfold_script.h"

namespace spia {

/// A script as far as it makes sense for a part.
struct ReadScript {
    UnfoldScript steps;
    std::vector<std::string> findings; ///< what of it made no sense on this part, and what became
                                       ///< of it; empty: all did
};

/// Reads a script (JSON; the form is documented in engine/pipeline/README.md). A region that it
/// names by a place is looked for there on this part, which may have changed: what is not found is
/// left out, with a finding; so is a step that then has nothing to move or would tear faces off.
/// @param map of the part
/// @throws InputError naming file, place and fault: no JSON, an unknown member, a value out of its
/// bounds, a face or a region
///                    that the part does not have, a choice that picks no face
ReadScript read_unfold_script(const std::filesystem::path& file, const PartFile& part, const BendMap& map);

/// A proposal as a script to be edited: regions are named, with the places by which they are found
/// again.
/// @param source_face of PartFile: numbers for faces on which there is friction and that are no
/// whole regions; empty: the mesh's own
std::string unfold_script_json(const BendMap& map, const UnfoldScript& steps, const std::vector<int>& source_face = {});

/// Likewise of any steps: faces are named by the regions and bends that lie wholly among them, the
/// others by their numbers in the part's file. A face of the file that was split is named whole.
std::string unfold_script_json(const PartFile& part, const BendMap& map, const UnfoldScript& steps);

} // namespace spia
