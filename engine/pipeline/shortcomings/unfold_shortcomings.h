#pragma once
#include <string>
#include <vector>

#include "engine/unfold/step/unfold_script.h"

namespace spia {

/// What makes the result of steps poorer than it should be, in words; empty if nothing does.
/// (Command line: exit 1 with --strict.) Of the states between only sheet counts that a step lays
/// on other sheet: what lay so before is told of the step that did it.
/// @param diagonal of the part, mm
/// @param findings what was found before, told first
std::vector<std::string> shortcomings(const UnfoldRun& run, double diagonal, const std::vector<std::string>& findings);

} // namespace spia
