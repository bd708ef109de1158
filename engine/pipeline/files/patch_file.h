#pragma once
#include <optional>
#include <string>

#include "engine/layout/layout.h"

namespace spia {

/// What --patches asks for: "one" and "best" nothing, "auto" a layout, else the JSON file of cuts
/// and corners, vertices of the part's file: {"cuts": [[12, 40, 77], ...], "corners": [3, 9, ...],
/// "edge_deg": 30, "smooth_joins": true}, each optional, but one of them.
/// @throws InputError if the file cannot be read or is not of that form; names the place
std::optional<LayoutOptions> patch_layout(const std::string& choice);

} // namespace spia
