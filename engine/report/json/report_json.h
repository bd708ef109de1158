#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/pipeline/run_chain.h"
#include "engine/pipeline/session.h"

namespace spia {

/// The result of a run as JSON, the contract of engine/pipeline/README.md. Stages that have not run
/// are left out.
/// @param write_seconds time of write_outputs()
/// @param failure what ended the chain before its end, if anything did
std::string report_json(const Session& session, const std::vector<std::filesystem::path>& files, double write_seconds,
                        const std::optional<Failure>& failure = {});

/// What was noted and done when the part was read, a line each: "note: cut open along ...".
std::vector<std::string> reading_notes(const PartFile& part);

/// What the mesh doctor says of a part as JSON.
std::string doctor_json(const std::filesystem::path& file, const PartFile& part);

} // namespace spia
