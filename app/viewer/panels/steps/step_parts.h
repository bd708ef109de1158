#pragma once
#include <string>

#include "app/viewer/panels/widgets.h"

/// The parts of the section "Step by step".
namespace spia::viewer {

/// A step in the list: its picture, name and figures, and below the chosen one what can be changed
/// of it.
void step_row(Frame& frame, int number);

/// Name, target, options, place in the list: of the chosen step.
void step_editor(Frame& frame, int number);

/// A step of one's own.
void new_step(Frame& frame);

/// The blank of the steps and its use for the chain.
void blank_of_steps(Frame& frame);
/// Whether it could be used for the chain and is not.
bool blank_of_steps_waits(const Document& document);

} // namespace spia::viewer
