#pragma once
#include "engine/coons/quad_grid.h"
#include "engine/core/progress.h"

namespace spia {

/// Unfolds the cells of a grid that comes from a map with kinks, and leaves it as it is otherwise:
/// each cell wants the mean shape and size of those around it, however oblong and sheared, where
/// untangle() wants them all alike. That is what cells need that hardly fit, as between the
/// windings of a spiral. Only cells that fold and those near them move, more of them where a few do
/// not do: on a fine grid that is a small part. The border stays. A grid that cannot be unfolded
/// comes back as far as it went: look at it with cell_quality().
/// @param around  cells on either side that the mean is taken of; more of them where that mean is
/// folded as well
void untangle_locally(QuadGrid& planar, int around, const Progress& progress = {});

} // namespace spia
