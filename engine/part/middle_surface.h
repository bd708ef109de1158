#pragma once
#include <vector>

#include "engine/mesh/sunk_holes.h"
#include "engine/part/part_file.h"

namespace spia {

/// Made from the skin at which fewer of the countersinks are cut off; seen from the outer one. Doubts what is not right there.
SkinMesh middle_surface(PartFile& part, const ThinSolid& sheet, const std::vector<SunkHole>& holes,
                        const ThinSolidOptions& units);

/// Of countersinks that are no holes all around.
void tell_open_sinks(PartFile& part, const ThinSolid& sheet, const std::vector<SunkHole>& holes);

} // namespace spia
