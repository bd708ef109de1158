#pragma once
#include <exception>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/cli/commands.h"
#include "engine/pipeline/report.h"
#include "engine/pipeline/session.h"

namespace spia::cli {

/// Grid and surface of a blank made in steps, by the stages of the chain.
struct SurfaceOfSteps {
    Session session;                ///< as far as the stages went
    std::optional<Failure> failure; ///< of the stage that ended them
    std::exception_ptr error;       ///< its own; null: none failed
};

/// Finds out before the work what would keep the surface and its report from being written.
/// @throws InputError, ExchangeError as require_place()
void require_surface_place(const UnfoldArguments& arguments, const PartFile& part);

/// Runs the chain from the blank of the steps on. @param run with a blank
SurfaceOfSteps surface_of_steps(const UnfoldArguments& arguments, const PartFile& part, const UnfoldRun& run,
                                const FlattenOptions& options);

/// Writes the files of `spia run` and its report into the folder of the arguments. @returns the files
std::vector<std::filesystem::path> write_surface(const UnfoldArguments& arguments, const SurfaceOfSteps& made);

} // namespace spia::cli
