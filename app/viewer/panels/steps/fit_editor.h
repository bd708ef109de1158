#pragma once
#include "app/viewer/model/document/fit_choice.h"
#include "app/viewer/panels/widgets.h"

namespace spia::viewer {

/// Tolerance, degree, ends and parameters of the surface.
void fit_editor(Frame& frame, FitChoice fit);

/// Of a surface that was to stay within a tolerance: how much of it does, the knots, and why not
/// all.
void fit_figures(Frame& frame, const SurfaceStage& surface);

} // namespace spia::viewer
