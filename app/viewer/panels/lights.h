#pragma once
#include "app/viewer/model/reports/lights.h"
#include "app/viewer/panels/widgets.h"

/// Lights and what stands behind them.
namespace spia::viewer {

/// A step's light: done only where nothing of it is doubted.
Status light(const Frame& frame, ChainStep step, Status made);

/// Why a step's light is not green, each with the next click.
void doubt_rows(Frame& frame, ChainStep step);

/// All of them, by step. @returns whether a click asked to see something in the views
bool all_doubt_rows(Frame& frame);

/// "Ready", or what is to be looked at: a click on that lists it all, with the clicks that answer
/// it.
void ready_light(Frame& frame);

} // namespace spia::viewer
