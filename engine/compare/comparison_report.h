#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/compare/compare.h"

namespace spia {

enum class TableStyle { text, markdown };

/// The rows as a table, below it why methods failed and what the columns mean.
std::string comparison_table(const std::vector<ComparisonRow>& rows, TableStyle style);

/// Schema spia.compare/1; engine/compare/README.md says what the keys mean. Infinite measures are
/// null.
/// @param notes of the part, such as where it was cut open
std::string comparison_json(const std::filesystem::path& file, const TriMesh& part,
                            const std::vector<ComparisonRow>& rows, const std::vector<std::string>& notes = {});

} // namespace spia
