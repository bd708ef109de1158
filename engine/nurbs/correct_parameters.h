#pragma once
#include "engine/core/progress.h"
#include "engine/nurbs/fit_attempt.h"

namespace spia {

class FootPointProjection;

/// Parameter correction: the points of a fit slide over the part to the feet of its surface, and it
/// is fitted again [Hoschek 1988], by mixed steps, for plain ones creep. Then, where there are few
/// enough points for many steps, with weights that grow where the surface is farthest away [Lawson
/// 1961]. Of all surfaces on the way the one whose largest distance at the points is least, of
/// those whose lines u and v do not lean over to one another much more than at first.
void correct_parameters(Attempt& fit, const FootPointProjection& projection, const Progress& progress = {});

} // namespace spia
