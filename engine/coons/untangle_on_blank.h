#pragma once
#include "engine/coons/blank_search.h"
#include "engine/coons/grid.h"
#include "engine/coons/untangle.h"
#include "engine/core/progress.h"

namespace spia {

/// Untangles the cells of a grid, see untangle(). Inner nodes may leave the blank on the way, into
/// a bay that a cell bridges: those are put back where the cells around allow it, else drawn back
/// with growing force. Look at the result with is_sound().
void untangle_on_blank(const BlankSearch& blank, GridResult& grid, const Progress& progress = {},
                       const UntangleOptions& options = {});

} // namespace spia
