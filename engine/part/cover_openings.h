#pragma once
#include <optional>

#include "engine/part/part_file.h"

namespace spia {

/// A part whose surface is closed but for a few missing triangles and slits, with these covered and
/// a finding that says so; nothing if it is another one. CAD faces are sewn by their reader.
std::optional<PartFile> with_openings_covered(const PartFile& part);

/// mm, the mean width of the widest opening of such a part; nothing if it is another one.
std::optional<double> slit_width(const PartFile& part);

} // namespace spia
