#pragma once
#include <optional>

#include "engine/coons/harmonic_map.h"
#include "engine/coons/place_border.h"
#include "engine/coons/quad_grid.h"

namespace spia {

/// Shares the square of a harmonic map out more evenly. The harmonic map squeezes lobes and windings of the blank into slivers
/// that fall between the nodes of any grid (a strip of length L and width w that hangs on one side decays like e^(-pi L / w));
/// here each triangle of the blank pulls towards its own shape and area, weighted with its area: unfold_elements() from the
/// harmonic map. A coarse mesh is divided on the way, so that the map bends in small steps.
/// @param oblong  columns over rows of the grid that is to come: the square is stretched by it for this
/// @param slide  vertices of the sides move along them, in their order; else they stay at their chord lengths
/// @return nothing if a triangle would stay folded
std::optional<HarmonicMap> opened_map(const HarmonicMap& map, double oblong, bool slide, const Progress& progress = {});

/// Where the lines i / columns and j / rows of the square meet the sides of the blank.
BorderParameters border_of_map(const HarmonicMap& map, const BlankBoundary& boundary, int columns, int rows);

} // namespace spia
