#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/pipeline/session.h"

namespace spia {

/// What makes a result poorer than it should be, in words; empty if nothing does. (Command line: exit 1 with --strict.)
std::vector<std::string> shortcomings(const Session& session);

/// The result of a run as JSON, the contract of engine/pipeline/README.md. Stages that have not run are left out.
/// @param write_seconds time of write_outputs()
std::string report_json(const Session& session, const std::vector<std::filesystem::path>& files, double write_seconds);

/// What the mesh doctor says of a part as JSON.
std::string doctor_json(const std::filesystem::path& file, const PartFile& part);

} // namespace spia
