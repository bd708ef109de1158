#pragma once
#include <vector>

#include "engine/mesh/solid/holes/open_sinks.h"
#include "engine/part/part_file.h"

namespace spia {

struct MiddleSurface {
    SkinMesh skin;   ///< seen from the outer skin
    Remarks remarks; ///< what is not right
};

/// Made from the skin at which fewer of the sinks are cut off: the straight wall below a sink ends
/// at the other one, and there the border is that of the hole.
MiddleSurface middle_surface(const TriMesh& solid, const ThinSolid& sheet, const std::vector<SunkHole>& holes,
                             const std::vector<OpenSink>& open, const ThinSolidOptions& units);

/// Of sinks that are no holes all around: what of them is laid flat.
/// @param taken  the surface that is, made of the triangles of a skin
Remarks on_open_sinks(const std::vector<OpenSink>& open, Skin taken, SheetSide side);

} // namespace spia
