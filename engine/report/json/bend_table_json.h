#pragma once
#include "engine/core/json_file.h"
#include "engine/unfold/plan/bend_table.h"

namespace spia {

/// The member "bend_table" of the reports, the contract of engine/pipeline/README.md.
Json bend_table_json(const BendTable& table);

} // namespace spia
