#pragma once
#include <vector>

#include "engine/nurbs/surface.h"

namespace spia {

/// Borders of `spans` spans along u (v) over which a surface changes alike: the (degree + 1)-th
/// root of its derivative of that order, estimated from the steps of the one before, is shared out
/// evenly [de Boor 2001, A Practical Guide to Splines, XII: newknot]. A least squares surface over
/// them needs fewer spans than one over halved spans.
/// @param surface  near to the one that is wanted, with two spans or more in that direction
std::vector<double> equidistributed_spans(const NurbsSurface& surface, bool along_u, int spans);

/// Per inner knot along u (v) about how far the surface would move without it, mm but for a factor:
/// the step of its highest derivative there times what the spans on both sides make of it [Lyche
/// and Moerken 1987].
std::vector<double> knot_significance(const NurbsSurface& surface, bool along_u);

} // namespace spia
