#pragma once
#include <optional>

#include "engine/coons/harmonic_map.h"
#include "engine/core/progress.h"

namespace spia {

struct AreaBalanceOptions {
    double oblong = 1;        ///< columns over rows of the grid that is to come: the square is
                              ///< stretched by it for this
    bool slide = false;       ///< vertices of the sides move along them, in their order; else they
                              ///< stay where they are
    double area_weight = 0.3; ///< against shape: what lobes need is their share of the square, more
                              ///< than their shape
};

/// Shares the square of a harmonic map out more evenly. The harmonic map squeezes lobes and
/// windings of the blank into slivers that fall between the nodes of any grid (a strip of length L
/// and width w that hangs on one side decays like e^(-pi L / w)); here each triangle of the blank
/// pulls towards its own shape and area, weighted with its area: untangle_elements() from the
/// harmonic map. A coarse mesh is divided on the way, so that the map bends in small steps.
/// @return nothing if a triangle would stay folded
std::optional<HarmonicMap> area_balanced_map(const HarmonicMap& map, const AreaBalanceOptions& options,
                                             const Progress& progress = {});

} // namespace spia
