#pragma once
#include <filesystem>
#include <vector>

#include "app/cli/commands.h"
#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/session.h"
#include "engine/report/json/report_json.h"

namespace spia::cli {

/// Finds out before the work what would keep the surface and its report from being written.
/// @throws InputError, ExchangeError as require_place()
void require_surface_place(const UnfoldArguments& arguments, const PartFile& part);

/// Runs the chain from the blank of the steps on, to its surface: a stage without a result ends it,
/// and what there is by then is worth writing. @param run  with a blank
ChainRun surface_of_steps(const UnfoldArguments& arguments, const PartFile& part, const UnfoldRun& run,
                          const FlattenOptions& options);

/// Writes the files of `spia run` and its report into the folder of the arguments. @returns the
/// files
std::vector<std::filesystem::path> write_surface(const UnfoldArguments& arguments, const ChainRun& made);

} // namespace spia::cli
