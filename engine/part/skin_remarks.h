#pragma once
#include <string>
#include <vector>

#include "engine/mesh/solid/border/onto_projection.h"
#include "engine/mesh/solid/holes/sunk_holes.h"
#include "engine/mesh/solid/marks/blind_holes.h"
#include "engine/mesh/solid/sheet_or_hollow.h"
#include "engine/mesh/solid/skin.h"
#include "engine/mesh/solid/stated_surface.h"
#include "engine/part/part_file.h"

// What users are told of a solid whose skin or middle surface is laid flat. Each is empty where
// there is nothing to tell.
namespace spia {

/// A doubt that says why it is a hollow body, if it may be another thing.
Remarks on_hollow(const TriMesh& mesh, const std::string& why);

/// A doubt where the edge of the blank is beside its place.
Remarks on_border(const TriMesh& middle, const GivenSolid& solid, double tolerance);

/// Of holes that cross the sheet askew, how they are laid flat.
Remarks on_oblique_holes(const SkinMesh& middle);

/// On a skin the holes that are sunk there are as wide as the tool that sinks them.
Remarks on_wide_holes(const std::vector<SunkHole>& holes, SheetSide taken);

/// What stands up from the sheet is no part of it.
Remarks on_bosses(const std::vector<SunkHole>& holes);

/// What does not go through the sheet is not cut out of it.
Remarks on_blind_holes(const std::vector<BlindHole>& holes);

/// A solid whose file says that it is one may still be a block.
Remarks on_block(const ThinSolid& sheet);

/// Of bends that are not as thick as the sheet; nothing if there are none.
Remarks on_uneven_bends(const TriMesh& solid, const ThinSolid& sheet, SheetSide laid,
                        const std::vector<StatedSurface>& surface);

/// Of wedges, and of solids that a simulation of forming has thinned.
Remarks on_taper(const ThinSolid& sheet);

/// @param uneven_told  bends that are not as thick as the sheet have been told with their radii
Remarks on_skin(const PartFile& part, bool uneven_told);

/// Which of the two it is that a closed surface is taken for, where the file does not say; empty if
/// it can be a solid of sheet alone.
Remarks on_either(const ThinSolid& sheet, ClosedSurface closed);

} // namespace spia
