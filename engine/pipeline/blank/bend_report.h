#pragma once
#include <string>
#include <vector>

#include "engine/part/part_file.h"
#include "engine/unfold/plan/bend_table.h"

namespace spia {

/// What the table has to say besides its rows: bends that are not laid, and where a K factor has no
/// effect.
std::vector<std::string> all_notes(const BendTable& table);

/// What makes the blank poorer: bends that it has with another length than their allowance, each
/// reason with the first of them and the way out; with a K factor also sheet that curves otherwise
/// than over a cylinder. That K has no effect at sharp folds is a note.
std::vector<std::string> bend_doubts(const PartFile& part, const BendTable& table, bool k_is_given);

/// A line each: what the lengths of the blank are lengths of, the bends (the first of many), the
/// notes.
std::vector<std::string> describe(const BendTable& table);

/// "R 3 mm, 90 degrees up, K 0.44, allowance 6.095 mm, deduction 3.905 mm"
std::string describe(const SheetBend& bend);

} // namespace spia
