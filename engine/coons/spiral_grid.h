#pragma once
#include <array>
#include <optional>
#include <vector>

#include "engine/coons/map_grid.h"

namespace spia {

/// For blanks that wind, like spirals, where cells of one shape do not fit: a map that gives lobes
/// and windings their area while its sides slide (area_balanced_map() twice), lines that are closer
/// together where cells would be long, and cells unfolded to the mean shape of those around them
/// (untangle_locally()).
/// @param context  with its harmonic map
/// @param counts  columns and rows, tried in turn
/// @param report  gets the attempts within
/// @return the first sound grid; nothing if there is none
std::optional<GridResult> spiral_grid(const GridContext& context, const std::vector<std::array<int, 2>>& counts,
                                      AttemptReport& report, const Progress& progress = {});

} // namespace spia
