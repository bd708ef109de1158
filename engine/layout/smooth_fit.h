#pragma once
#include "engine/layout/fit_patches.h"
#include "engine/layout/patches_judge.h"

namespace spia {

/// Makes the joins of fitted patches smooth, see smooth_joins(). A patch that would leave the
/// tolerance for it (or be farther away than it is already), fold, be ill-shaped (see
/// well_shaped_jacobian), or have a greater angle at one of its sides, stays as it was; its
/// neighbours then do what they can alone. `fit.joins` says what came of it.
/// @param now  how the patches are judged as they are
/// @returns the judgement of what `fit` holds afterwards
PatchesJudgement smooth_fit(PatchesFit& fit, const PatchesJudge& judge, PatchesJudgement now, double tolerance,
                            const Progress& progress = {});

} // namespace spia
