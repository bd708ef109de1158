#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/part/part_file.h"
#include "engine/unfold/plan/bend_table.h"
#include "engine/unfold/plan/bends.h"
#include "engine/unfold/step/polish.h"
#include "engine/unfold/step/unfold_script.h"

namespace spia {

/// What a run gave (schema spia.unfold-result/1, engine/pipeline/README.md).
/// @param files    written, in order
/// @param polished null: not asked for, or there was none
/// @param table    of the bends on the blank; null: not made
std::string unfold_report_json(const std::filesystem::path& input, const PartFile& part, const BendMap& map,
                               const UnfoldScript& steps, const UnfoldRun& run,
                               const std::vector<std::string>& findings,
                               const std::vector<std::filesystem::path>& files, const PolishedBlank* polished = nullptr,
                               const BendTable* table = nullptr);

} // namespace spia
