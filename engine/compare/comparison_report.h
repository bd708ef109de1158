#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/compare/compare.h"

namespace spia {

enum class TableStyle { text, markdown };

/// The rows as a table, below it why methods failed and what the columns mean.
std::string comparison_table(const std::vector<ComparisonRow>& rows, TableStyle style);

/// Schema spia.compare/1; engine/compare/README.md says what the keys mean. Infinite measures are null.
std::string comparison_json(const std::filesystem::path& file, const TriMesh& part,
                            const std::vector<ComparisonRow>& rows);

} // namespace spia
