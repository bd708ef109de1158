#pragma once
#include "app/viewer/panels/ui.h"

namespace spia::viewer {

/// Where the neutral fibre lies: a number, a table of the program, or a file.
void k_factor_control(Frame& frame);

/// Which surface the lengths of the blank are of, and each bend with radius, angle, K, allowance
/// and deduction; a click goes to it.
void bend_rows(Frame& frame);

} // namespace spia::viewer
