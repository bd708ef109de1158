#pragma once
#include "engine/core/progress.h"
#include "engine/pipeline/session.h"

namespace spia {

/// Runs one stage on a copy of the session; the results of later stages, which it makes stale, are
/// dropped.
/// @param watch  sees the blank while it is solved for, straight as the result will lie
/// @throws InputError  if an earlier stage has not run; else what the stage throws
Session run_stage(Stage stage, Session session, const Progress& progress = {}, const StepWatch& watch = {});

} // namespace spia
